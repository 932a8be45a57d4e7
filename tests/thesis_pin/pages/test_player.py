"""Scenes reach the page whole; the viewer's modules stay light."""

import base64
import json
import re
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from example_robots import NAMES, SHARE

from thesis_pin.pages import packing, scene
from thesis_pin.pages import player as viewer

TIME = np.linspace(0.0, 1.0, 5)
GROUPS = (scene.Group("a", "all"),)


def made(*items):
    return scene.Scene(title="t", description="d", time=TIME, groups=GROUPS, items=items)


def ball(name, position):
    return scene.Ball(name, "a", position, 0.1, ("#000000",))


def decoded(buffer):
    """The player's format, read by a reader of its own."""
    (length,) = struct.unpack("<I", buffer[:4])
    content = buffer[4 + length :]
    quarter = len(content) // 4
    planes = (content[k * quarter : (k + 1) * quarter] for k in range(4))
    differences = [int.from_bytes(four, "little") for four in zip(*planes, strict=True)]

    def revive(value):
        if set(value) == {"$"}:
            start, count, width = value["$"]
            columns = np.reshape(differences[start : start + count], (width, -1))
            bits = (np.cumsum(columns, axis=1) % 2**32).astype("<u4")
            return np.ascontiguousarray(bits.T).view("<f4").ravel()
        return value

    return json.loads(buffer[4 : 4 + length], object_hook=revive), quarter


def test_encoding_keeps_every_number_to_single_precision():
    path = np.random.default_rng(5).normal(size=(5, 3))
    arrow = scene.Arrow("arrow", "a", path, 2 * path, 0.5, 0.01, "#112233")
    document, _ = decoded(viewer.encode(made(ball("ball", path), arrow)))
    first, second = document["items"]
    np.testing.assert_array_equal(first["samples"]["position"], path.astype("f4").ravel())
    np.testing.assert_array_equal(second["samples"]["vector"], (2 * path).astype("f4").ravel())
    assert (second["kind"], second["scale"], second["colour"]) == ("arrow", 0.5, "#112233")
    np.testing.assert_array_equal(document["time"], TIME.astype("f4"))


def test_places_that_are_unknown_and_of_any_size_come_back_to_the_bit():
    path = np.array([[np.nan, -0.0, 3e38], [1e-40, -1e-45, np.nan], *np.eye(3)])
    document, _ = decoded(viewer.encode(made(ball("ball", path))))
    found = document["items"][0]["samples"]["position"]
    np.testing.assert_array_equal(found.view("u4"), path.astype("f4").ravel().view("u4"))


def test_arrays_of_nothing_are_nothing():
    arrays = {"none": np.empty((0, 3)), "no": np.empty(0), "one": np.ones(1)}
    document, _ = decoded(packing.encode(arrays))
    assert [len(document[name]) for name in ("none", "no", "one")] == [0, 0, 1]


READ = """(() => {
  const scene = decodeScene(Uint8Array.from(atob(%s), (one) => one.charCodeAt(0)).buffer);
  return Object.values(scene).map((array) => Array.from(new Uint32Array(array.buffer)));
})()"""


@pytest.mark.browser
def test_the_page_reads_every_bit_of_every_array_also_behind_an_empty_one(browser, tmp_path):
    (tmp_path / "page.html").write_bytes(viewer.html(made(ball("ball", np.zeros((5, 3))))))
    browser.open((tmp_path / "page.html").as_uri())
    browser.until("window.player && player.framesDrawn > 0")
    random = np.random.default_rng(7)
    arrays = {
        "none": np.empty((0, 3)),
        "time": TIME,
        "odd": np.array([np.inf, -0.0, 3e38, 1e-40, -1e-45, -1.0]),
        "places": random.normal(size=(7, 3)),
        "matrices": random.normal(size=(3, 4, 4)),
        "column": np.arange(6.0),
        "columns": np.arange(6.0).reshape(3, 2).T,  # the same numbers, column by column
        "again": TIME,
    }
    content = base64.b64encode(packing.encode(arrays)).decode()
    found = browser.run(READ % json.dumps(content))
    for bits, array in zip(found, arrays.values(), strict=True):
        assert bits == array.astype("<f4").ravel().view("<u4").tolist()


def test_arrays_that_items_share_are_stored_once():
    items = [ball(f"ball {k}", np.arange(15.0).reshape(5, 3)) for k in range(20)]
    _, floats = decoded(viewer.encode(made(*items)))
    assert floats == 15 + len(TIME)


def test_the_example_of_the_documents_runs(tmp_path, monkeypatch):
    document = Path(__file__).parents[3] / "docs" / "viewer.md"
    section = document.read_text(encoding="utf-8").split("## Any Pinocchio model")[1]
    code = re.findall(r"```python\n(.*?)```", section, flags=re.DOTALL)[0]
    robots = SHARE / "example-robot-data" / "robots" / NAMES[0]
    monkeypatch.chdir(tmp_path)
    exec(code.replace('"panda.urdf"', repr(str(robots))).replace('"share"', repr(str(SHARE))), {})
    assert (tmp_path / "panda.html").stat().st_size > 1e5


def test_importing_the_viewer_imports_nothing_heavy():
    code = (
        "import sys; from thesis_pin.pages import drawing, page, player, scene, serving\n"
        "heavy = {'pinocchio', 'scipy', 'matplotlib', 'meshcat', 'plotly', 'jinja2'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
