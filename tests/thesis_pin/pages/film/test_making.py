"""Films and pictures of scenes: decoded again, by ffmpeg and by Pillow."""

import io
import subprocess
import tempfile

import chromium
import numpy as np
import pytest
from loops import beside
from PIL import Image

from thesis_pin.errors import BadInput
from thesis_pin.pages.film import making
from thesis_pin.pages.film.camera import View
from thesis_pin.pages.film.encoding import Encoder, ffmpeg, palette
from thesis_pin.pages.scene import Ball, Group, Readout, Scene

RED, BLUE = "#D55E00", "#0072B2"
SMALL = View(320, 180)
NAMED = {"mp4": "h264", "webm": "vp9"}


@pytest.fixture(scope="module")
def needs_browser():
    """Skip without what films are made with."""
    pytest.importorskip("imageio_ffmpeg", reason="pip install 'thesis-pin[film]'")
    if chromium.find() is None:
        pytest.skip("no Chromium on this machine (Debian and Ubuntu: apt-get install chromium)")


def moving(label="two balls", seconds=1.0):
    """A red ball that goes up beside a blue one that rests."""
    time = np.linspace(5.0, 5.0 + seconds, 41)
    up = np.zeros((41, 3))
    up[:, 2] = np.linspace(0.1, 0.9, 41)
    rest = np.tile([0.9, 0.0, 0.5], (41, 1))
    return Scene(
        title=label,
        description="One ball rises.",
        time=time,
        groups=(Group("mover", "mover"), Group("rest", "rest")),
        items=(Ball("up", "mover", up, 0.1, (RED,)), Ball("still", "rest", rest, 0.1, (BLUE,))),
        readouts=(Readout("height", up[:, 2], "m", 3),),
    )


def decoded(film, kind):
    """A film's frames as ``(n, height, width, 3)``, and ffmpeg's line on their stream."""
    command = [ffmpeg(), "-hide_banner", "-f", kind if kind != "webm" else "matroska", "-i", "-"]
    done = subprocess.run(
        [*command, "-fps_mode", "passthrough", "-c:v", "png", "-f", "image2pipe", "-"],
        input=film,
        capture_output=True,
        check=True,
    )
    (line,) = (one for one in done.stderr.decode().splitlines() if " Video: " + NAMED[kind] in one)
    pictures = done.stdout.split(b"\x89PNG\r\n\x1a\n")[1:]
    frames = [opened(b"\x89PNG\r\n\x1a\n" + one) for one in pictures]
    return np.array(frames), line


def opened(picture):
    """A picture as ``(height, width, 3)`` numbers from 0 to 255."""
    return np.asarray(Image.open(io.BytesIO(picture)).convert("RGB")).astype(int)


def middle_of(frame, colour):
    """Row and column of the middle of what is red, or blue."""
    redder = frame[..., 0] - frame[..., 2]
    return np.argwhere(redder > 80 if colour == RED else redder < -80).mean(axis=0)


@pytest.mark.browser
@pytest.mark.parametrize("kind", ["mp4", "webm"])
def test_a_film_has_every_frame_in_its_size_and_shows_the_motion(kind, needs_browser):
    told = []
    film = making.film(
        moving(),
        kind,
        view=View(319, 181, "front"),
        rate=10,
        speed=0.5,
        progress=lambda *step: told.append(step),
    )
    frames, line = decoded(film, kind)
    assert frames.shape == (21, 182, 320, 3)  # two seconds, and both ends
    assert "10 fps" in line
    assert told == [(k, 21) for k in range(21)]
    heights = [middle_of(frame, RED)[0] for frame in frames]
    assert (np.diff(heights) < -2).all()  # up, which is fewer rows
    assert np.ptp([middle_of(frame, BLUE) for frame in frames], axis=0).max() < 1.5
    picture = opened(making.picture(moving(), at=0.5, view=View(320, 182, "front")))
    assert np.abs(frames[10] - picture).mean() < 2
    assert np.abs(frames[0] - picture).mean() > 1.5 * np.abs(frames[10] - picture).mean()


@pytest.mark.browser
def test_a_gif_runs_for_ever_at_its_pace_and_keeps_rare_colours(needs_browser):
    film = making.film(moving(), "gif", view=View(321, 181, "front"), rate=5)
    gif = Image.open(io.BytesIO(film))
    assert (gif.n_frames, gif.size, gif.info["loop"]) == (6, (321, 181), 0)
    assert gif.info["duration"] == 200
    heights = []
    for k in range(gif.n_frames):
        gif.seek(k)
        frame = np.asarray(gif.convert("RGB")).astype(int)
        heights.append(middle_of(frame, RED)[0])
        assert np.isfinite(middle_of(frame, BLUE)).all()
    assert (np.diff(heights) < -4).all()


@pytest.mark.browser
def test_the_same_scene_gives_the_same_picture_without_controls_or_scene_s_tricks(needs_browser):
    tricky = moving("</script><script>document.body.remove()</script>")
    first, second = (making.picture(tricky, at=0.25, view=SMALL) for _ in range(2))
    assert first == second
    assert opened(first).shape == (180, 320, 3)
    assert np.isfinite(middle_of(opened(first), RED)).all()


def test_moments_reach_both_ends_whatever_the_rate():
    times = making.moments(moving(seconds=0.3), 10.0)
    np.testing.assert_allclose(times, [0, 0.1, 0.2, 0.3], atol=1e-12)
    slow = making.moments(moving(), 30.0, 0.5)
    assert len(slow) == 61
    assert slow[-1] <= 1.0
    np.testing.assert_allclose(np.diff(slow), 1 / 60, atol=1e-9)
    assert making.moments(moving(), 1.0, 1000.0).tolist() == [0.0]


@pytest.mark.parametrize(
    ("wrong", "what"),
    [
        ({"rate": 0.5}, "rate"),
        ({"rate": 51}, "rate"),
        ({"rate": float("nan")}, "rate"),
        ({"speed": 0}, "speed"),
        ({"kind": "avi"}, "kind"),
        ({"scene": "a scene"}, "scene"),
    ],
)
def test_films_out_of_bounds_are_refused(wrong, what):
    arguments = {"scene": moving(), "kind": "gif"} | wrong
    with pytest.raises(BadInput, match=what):
        making.film(arguments.pop("scene"), arguments.pop("kind"), **arguments)


@pytest.mark.parametrize("at", [-0.1, 1.1, float("nan")])
def test_pictures_of_moments_outside_the_motion_are_refused(at):
    with pytest.raises(BadInput, match="at is"):
        making.picture(moving(), at=at)


@pytest.mark.parametrize("name", ["film", "film.avi", ".mp4", "", "film.mp4.txt", None, "-"])
def test_files_whose_ending_names_no_film_are_refused(name):
    with pytest.raises(BadInput, match=r"\.mp4, \.webm or \.gif"):
        making.write_film(moving(), name)
    with pytest.raises(BadInput, match=r"\.png"):
        making.write_picture(moving(), name)


@pytest.mark.parametrize("wrong", [(63, 720), (1280, 5000), (1280.0, 720), (True, 720)])
def test_sizes_that_can_t_be_drawn_are_refused(wrong):
    with pytest.raises(BadInput, match=r"width|height"):
        View(*wrong)


def test_an_unknown_look_names_those_there_are():
    with pytest.raises(BadInput, match="3d, front, side, top"):
        View(look="below")


def test_an_encoder_that_fails_says_why_and_leaves_nothing_running():
    pytest.importorskip("imageio_ffmpeg")
    with Encoder("mp4", 10.0) as encoder:
        encoder.write(b"no picture at all" * 1000)
        with pytest.raises(BadInput, match="ffmpeg ended with"):
            encoder.content()
    assert encoder._process.poll() is not None


def test_an_encoder_that_dies_without_a_word_is_told_with_the_folder_that_may_be_full(
    monkeypatch,
):
    monkeypatch.setattr("thesis_pin.pages.film.encoding.ffmpeg", lambda: "false")
    with Encoder("mp4", 10.0) as encoder:
        with pytest.raises(BadInput, match="code 1 and said nothing") as refused:
            encoder.content()
        assert tempfile.gettempdir() in str(refused.value)
        assert "TMPDIR" in str(refused.value)


def test_a_palette_holds_the_colour_of_a_few_pixels():
    picture = Image.new("RGB", (200, 200), (244, 246, 248))
    for k in range(200):
        for j in range(100):
            picture.putpixel((k, j), (k + 40, k + 41, j + 100))
    picture.putpixel((3, 150), (213, 94, 0))
    content = io.BytesIO()
    picture.save(content, "PNG")
    colours = np.asarray(Image.open(io.BytesIO(palette([content.getvalue()])))).reshape(-1, 4)
    assert colours.shape == (256, 4)
    assert (colours[:, 3] == 0).sum() == 1
    assert np.abs(colours[:, :3].astype(int) - [213, 94, 0]).max(axis=1).min() < 12


@pytest.mark.browser
def test_films_are_made_while_a_loop_runs_as_in_a_notebook(needs_browser):
    import asyncio

    async def cell():
        return making.picture(moving(), view=SMALL)

    made = beside(lambda: asyncio.run(cell()))
    assert opened(made).shape == (180, 320, 3)
