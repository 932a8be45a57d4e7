"""What a report's page looks like on paper."""

import numpy as np
import pytest

pdfium = pytest.importorskip("pypdfium2", reason="pip install pypdfium2")

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def printed(running_browser, report_file):
    """The report as PDF, and where its page stood before and after."""
    running_browser.open(report_file.as_uri())
    running_browser.until("window.ready")
    running_browser.run("player.pause(); player.time = 0.5; player.look('top')")
    state = "[player.time, ...player.stage.camera.position.toArray(), player.stage.open]"
    before = running_browser.run(state)
    content = running_browser.page.pdf(format="A4", prefer_css_page_size=True)
    after = running_browser.run(state)
    assert running_browser.complaints() == []
    running_browser.leave()
    document = pdfium.PdfDocument(content)
    yield document, before, after
    document.close()


def test_the_page_is_as_it_was_before_it_was_printed(printed):
    _, before, after = printed
    np.testing.assert_allclose(after, before, atol=1e-9)


def test_the_robot_is_printed_at_three_moments_that_differ_and_no_key_is_told(printed, report):
    document, *_ = printed
    texts = [page.get_textpage().get_text_range() for page in document]
    (shown,) = (k for k, text in enumerate(texts) if "The motion" in text)
    seconds = report.motion.time[-1] - report.motion.time[0]
    for name, time in (("start", 0), ("middle", seconds / 2), ("end", seconds)):
        assert f"{name}, {time:.2f} s" in texts[shown]
    for words in ("space plays", "pause", "zooming", "double-click", "Unpacking"):
        assert not any(words in text for text in texts)
    assert "support polygon" in texts[shown]
    images = [
        one.get_bitmap().to_numpy()[..., :3].astype(int)
        for one in document[shown].get_objects()
        if isinstance(one, pdfium.PdfImage)
    ]
    assert [image.shape for image in images] == [(620, 720, 3)] * 3
    for k in range(3):
        assert (np.ptp(images[k], axis=-1) > 80).mean() > 0.01  # coloured, as only the robot is
        assert (np.abs(images[k] - images[k - 1]).max(axis=-1) > 60).mean() > 0.005


def test_nothing_reaches_over_a_printed_page(printed):
    document, *_ = printed
    assert len(document) > 3
    for page in document:
        drawn = page.render(scale=1).to_numpy()[..., :3].astype(int)
        margin = 20  # points, where 34 are left free
        edges = (drawn[:, :margin], drawn[:, -margin:], drawn[:margin], drawn[-margin:])
        assert all((edge > 250).all() for edge in edges)


def test_the_colour_of_the_answer_stays_on_paper(printed, report):
    document, *_ = printed
    drawn = document[0].render(scale=1).to_numpy()[..., 2::-1].astype(int)  # red, green, blue
    colour = (0, 114, 178) if report.within_limits else (213, 94, 0)
    bar = (np.abs(drawn[:, 30:44] - colour).max(axis=-1) < 30).any(axis=1)
    assert bar.sum() > 40  # as high as a few lines
