"""Broken files by the thousand: only our own errors may come out, and soon.

``python tests/fuzz.py [count] [seed]`` changes the project's own files at random, reads
them and works with what is read. It ends with 1 if anything but an error of
``thesis_pin.errors`` came out or an input took longer than ten seconds; the inputs
are then kept in a folder that it names. The test suite runs a few hundred.
"""

from __future__ import annotations

import random
import re
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LOOPS = ROOT / "tests" / "thesis_pin" / "loops" / "data"
SLOWEST = 10.0
"""Time of the processor that one input may take [s]."""

ODD = [
    *("0", "-1", "1e308", "-1e308", "1e-308", "1e-160", "1e150", "1e12", "1e-9", "1e400", "9" * 20),
    *("nan", "inf", "-inf", "1_0", "0x10", "1e", "1,5", "1979-05-27", "true", "abc", "${x}"),
    *(
        "[]",
        "{}",
        "[[]]",
        '""',
        '"\\u001b[31m"',
        "&a",
        "*a",
        "[*a]",
        "!!set",
        "'",
        '"',
        "]]]",
        "{{{",
    ),
    *("<mass/>", "<!--", "<![CDATA[", "&lt;", "&#27;", "left", "right", "double"),
    *("\x1b", "\x00", "\ufeff", "\u202e"),
]
NUMBER = re.compile(r"-?\d+\.?\d*(?:e-?\d+)?")
WORD = re.compile(r"\w+|[^\w\s]")


def changed(text: str, dice: random.Random) -> bytes:
    """A text with one number changed, or one to four random changes."""
    if dice.random() < 0.5 and (found := list(NUMBER.finditer(text))):
        match = dice.choice(found)
        value = float(match[0]) or 1.0
        factor = dice.choice([-1, 0, 0.5, 1.01, 3, 10, 1e-3, 1e3, 1e-8, 1e6, 1e9, 1e11])
        return f"{text[: match.start()]}{value * factor:g}{text[match.end() :]}".encode()
    for _ in range(dice.randint(1, 4)):
        kind = dice.randrange(9)
        lines = text.split("\n")
        k = dice.randrange(len(lines))
        at, end = sorted(dice.randrange(len(text) + 1) for _ in range(2))
        if kind <= 2 and (found := list((WORD if kind == 2 else NUMBER).finditer(text))):
            match = dice.choice(found)
            text = text[: match.start()] + dice.choice(ODD) + text[match.end() :]
        elif kind == 3:
            del lines[k]
            text = "\n".join(lines)
        elif kind == 4:
            lines.insert(dice.randrange(len(lines)), lines[k])
            text = "\n".join(lines)
        elif kind == 5:
            text = text[:at] + dice.choice(ODD) + text[at:]
        elif kind == 6:
            end = min(end, at + 200)
            text = text[:at] + text[end:]
        elif kind == 7:
            text = text[:at] + text[at : at + 40] * dice.choice([2, 50, 500]) + text[at:]
        elif kind == 8 and len(lines) > 2:
            other = dice.randrange(len(lines))
            lines[k], lines[other] = lines[other], lines[k]
            text = "\n".join(lines)
        text = text or "\n"
    content = bytearray(text.encode("utf-8", "surrogatepass"))
    if dice.random() < 0.1 and content:
        content[dice.randrange(len(content))] = dice.randrange(256)
    return bytes(content)


def targets() -> dict[str, tuple[str, str, Callable[[Path], object]]]:
    """Name → text to change, ending of the file, and what reads and uses it."""
    import numpy as np

    import pollard_pin
    import scout_pin
    from thesis_pin.loops.kinematics import mobility
    from thesis_pin.loops.loading import load
    from thesis_pin.model.pair import pair

    scout, pollard = scout_pin.load(), pollard_pin.load()
    pose = [0.45, 0.05, 0.05, 0.1, 0.2, 0.1]

    def specification(path: Path) -> object:
        robot = scout_pin.load(path)
        return scout_pin.gait_report(robot, scout_pin.load_gait(), samples=5)

    def gait(path: Path) -> object:
        return scout_pin.gait_report(scout, scout_pin.load_gait(path), samples=5)

    def arm(path: Path) -> object:
        return pollard_pin.load(path).inverse_kinematics(pose)

    def spray(path: Path) -> object:
        return pollard_pin.trajectory_report(pollard, pollard_pin.load_path(path), samples=5)

    def loops(path: Path) -> object:
        robot = load(LOOPS / "five_bar.urdf", path)
        return mobility(robot, robot.q0)

    def tree(path: Path) -> object:
        robot = load(path, LOOPS / "five_bar.yaml")
        return mobility(robot, robot.q0)

    def dialects(path: Path) -> object:
        robot = load(path)
        return pair(robot.description), mobility(robot, robot.q0)

    def beside(path: Path) -> object:
        robot = load(LOOPS / "dialects.urdf", path)
        return pair(robot.description), mobility(robot, robot.q0)

    time = np.linspace(0, 1, 9)
    walk = "t,support,torso_x,torso_z,left_foot_y\n" + "".join(
        f"{t:g},{'left' if t < 0.5 else 'double'},{0.01 * t:g},0.25,0.02\n" for t in time
    )
    tool = "time_s,x_m,y_m,z_m,psi_deg,theta_deg,phi_deg\n" + "".join(
        f"{t:g},{0.45 + 0.01 * t:g},0.05,0.05,1,2,3\n" for t in time
    )
    packages = Path(scout_pin.__file__).parent, Path(pollard_pin.__file__).parent
    return {
        "specification": (
            (packages[0] / "specifications" / "scout.toml").read_text(),
            ".toml",
            specification,
        ),
        "gait": ((ROOT / "examples" / "walk.toml").read_text(), ".toml", gait),
        "preset": ((packages[0] / "gaits" / "thesis.toml").read_text(), ".toml", gait),
        "samples": (walk, ".csv", gait),
        "arm": ((packages[1] / "specifications" / "pollard.toml").read_text(), ".toml", arm),
        "path": ((ROOT / "examples" / "spray_arch.toml").read_text(), ".toml", spray),
        "poses": (tool, ".csv", spray),
        "loops": ((LOOPS / "five_bar.yaml").read_text(), ".yaml", loops),
        "dialects": ((LOOPS / "dialects.urdf").read_text(), ".urdf", dialects),
        "beside": ((LOOPS / "dialects.yaml").read_text(), ".yaml", beside),
        "tree": ((LOOPS / "five_bar.urdf").read_text(), ".urdf", tree),
    }


def _late(*_: object) -> None:
    raise TimeoutError(f"more than {SLOWEST:g} s")


def main(count: int, seed: int) -> int:
    """Try so many inputs; 1 if something else than our errors came out."""
    from thesis_pin.errors import ThesisPinError

    signal.signal(signal.SIGPROF, _late)
    dice, kinds = random.Random(seed), list(targets().items())
    outcomes: Counter[str] = Counter()
    slowest, failed = 0.0, 0
    kept = Path(tempfile.mkdtemp(prefix="fuzz_"))
    for number in range(count):
        name, (text, ending, use) = kinds[number % len(kinds)]
        path = kept / f"{number}_{name}{ending}"
        path.write_bytes(changed(text, dice))
        start = time.process_time()
        signal.setitimer(signal.ITIMER_PROF, SLOWEST)
        try:
            use(path)
            outcomes["taken"] += 1
        except ThesisPinError as error:
            outcomes["refused"] += 1
            message = str(error)
            if len(message) > 10_000 or not message.replace("\n", " ").isprintable():
                raise AssertionError(f"{path}: {message[:200]!r}") from None
        except Exception:
            failed += 1
            signal.setitimer(signal.ITIMER_PROF, 0)
            print(f"{path}\n{traceback.format_exc(limit=-3)}", flush=True)
            continue
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
        slowest = max(slowest, time.process_time() - start)
        path.unlink()
    print(f"{dict(outcomes)}, {failed} failed, slowest {slowest:.1f} s")
    if not failed:
        kept.rmdir()
    return int(failed > 0)


if __name__ == "__main__":
    words = [int(word) for word in sys.argv[1:]]
    sys.exit(main(*words, *(20_000, 1)[len(words) :]))
