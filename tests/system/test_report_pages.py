"""Report pages in a real browser: whole, quiet, beside the animation, and safe to open."""

import socket

import pytest

from scout_pin.report.drawn.page import gait_page
from scout_pin.report.drawn.view import gait_scene
from thesis_pin.pages import page
from thesis_pin.pages import player as viewer

pytestmark = pytest.mark.browser


def test_the_report_page_is_complete_quiet_and_fits_a_phone(browser, report_file, artefacts):
    for width, height, mobile in ((1280, 900, False), (390, 844, True)):
        browser.open(report_file.as_uri(), width, height, mobile)
        browser.until("window.ready && player.framesDrawn > 0")
        assert browser.requests() == [report_file.as_uri()]
        assert browser.complaints() == []
        plots = browser.run("document.querySelectorAll('.plot').length")
        assert (
            browser.run("document.querySelectorAll('.plot .main-svg .cartesianlayer').length")
            == plots
        )
        assert browser.run("document.documentElement.scrollWidth") <= width
        assert browser.cut_numbers() == []
        browser.run("player.pause(); player.time = 1.5")
        browser.still(artefacts / f"report_{width}.png")
    assert report_file.stat().st_size < 3e6


LEGENDS = """[...document.querySelectorAll(".plot .canvas")].map((plot) => {
  const box = (name) => plot.querySelector(name).getBoundingClientRect();
  const whole = plot.getBoundingClientRect(), legend = box(".legend");
  const bar = plot.querySelector(".legend .scrollbar")?.getBoundingClientRect().height || 0;
  return [legend.top - box(".xtitle").bottom, whole.bottom - legend.bottom,
    box(".ytitle").left - whole.left, -bar];
})"""
"""How far a legend is from what is above and below, a y axis's title from the edge; no bar."""


def test_legends_are_whole_and_cover_nothing(browser, report_file):
    for width in (1280, 390):
        browser.open(report_file.as_uri(), width, 844)
        browser.until("window.ready")
        rooms = browser.run(LEGENDS)
        assert len(rooms) > 8
        assert min(min(room) for room in rooms) >= 0, rooms


def test_a_page_without_animation_or_plots_needs_neither_library(browser, folder):
    bare = page.Page(
        title="Audit",
        subtitle="no motion here",
        good=False,
        verdict=["Two equations fail."],
        tiles=[page.Tile("fail", "2", False)],
        plots=[],
        tables=[page.Table("Claims", ("claim", "verdict"), [("(4.1)", "wrong")], prose=True)],
    )
    file = folder / "bare.html"
    file.write_bytes(page.html(bare))
    browser.open(file.as_uri())
    browser.until("window.ready")
    assert file.stat().st_size < 2e4
    text = browser.run("document.querySelector('main').innerText")
    assert "Two equations fail." in text
    assert "Plots" not in text
    assert browser.complaints() == []


def test_a_table_in_a_phone_breaks_lines_but_no_numbers(browser, folder):
    row = ("forearm", "inertia (0.000199423, -5.176e-06, 0, 0.000199423), <b>masses</b> 0.25")
    rest = (30 * "why ", 30 * "and ")
    table = page.Table("Assumptions", tuple("abcd"), [(*row, *rest)], prose=True)
    numbers = page.Table("Numbers", tuple("abcdefgh"), [("0.123456789",) * 8])
    bare = page.Page("Page", "", None, ["?"], [page.Tile("n", "1")], [], [table, numbers])
    file = folder / "phone.html"
    file.write_bytes(page.html(bare))
    browser.open(file.as_uri(), 390, 844, True)
    browser.until("window.ready")
    assert browser.run("document.querySelectorAll('td')[1].innerText") == row[1]
    assert browser.cut_numbers() == []
    assert browser.run("document.documentElement.scrollWidth") <= 390
    browser.run("document.querySelectorAll('.number').forEach((one) => one.className = '')")
    assert len(browser.cut_numbers()) >= 1  # what the class is for


def test_colours_that_mean_something_stay_where_the_system_chooses_them(browser, report_file):
    seen = (
        "[...document.querySelectorAll('.swatch, .cursor')]"
        ".map((one) => getComputedStyle(one).backgroundColor)"
    )
    texts = "[...document.querySelectorAll('.plot text')].map((one) => getComputedStyle(one).fill)"
    found = []
    for wishes in ({}, {"forced_colors": "active", "color_scheme": "dark"}):
        browser.open(report_file.as_uri(), **wishes)
        browser.until("window.ready && player.framesDrawn > 0")
        assert browser.run("matchMedia('(forced-colors: active)').matches") == bool(wishes)
        found.append((browser.run(seen), browser.run(texts)))
    assert len(set(found[0][0])) > 5
    assert found[1] == found[0]
    edge = "getComputedStyle(document.querySelector('.swatch')).borderTopColor"
    assert browser.run(edge) == browser.run("getComputedStyle(document.body).color")


def test_the_report_answers_first(browser, report_file, report):
    browser.open(report_file.as_uri())
    browser.until("window.ready")
    order = browser.run("document.querySelector('main').innerText")
    places = [
        order.index(text)
        for text in (
            report.verdict()[0],
            "The motion",
            "Stability margin",
            "Joints",
            "Assumptions",
            "Parameters",
            "Software",
        )
    ]
    assert places == sorted(places)


def test_plots_follow_the_animation_and_a_click_goes_to_its_moment(browser, report_file):
    browser.open(report_file.as_uri())
    browser.until("window.ready && player.framesDrawn > 0")
    browser.run("player.pause()")
    place = (
        "(() => { const plot = document.querySelectorAll('.plot')[1];"
        "const box = plot.querySelector('.nsewdrag').getBoundingClientRect();"
        "const cursor = plot.querySelector('.cursor').getBoundingClientRect();"
        "return (cursor.left + cursor.width / 2 - box.left) / box.width; })()"
    )
    for share in (0.25, 0.8):
        browser.run(f"player.time = {share} * player.duration")
        assert browser.run(place) == pytest.approx(share, abs=0.01)
    browser.run(
        "document.querySelectorAll('.plot .canvas')[1].emit('plotly_click', {points: [{x: 1.25}]})"
    )
    assert browser.run("player.time") == pytest.approx(1.25)


def test_a_page_cannot_be_made_to_ask_any_network(browser, view_file, report_file):
    with socket.create_server(("127.0.0.1", 0)) as listening:
        listening.setblocking(False)
        address = f"http://127.0.0.1:{listening.getsockname()[1]}/"
        for file in (view_file, report_file):
            browser.open(file.as_uri())
            browser.until("window.player && player.framesDrawn > 0")
            asked = f"fetch('{address}').then(() => 'sent', (error) => String(error))"
            assert "TypeError" in browser.run(asked)
            browser.run(
                "new Promise((done) => { const image = new Image(); image.onerror = () => done();"
                f"image.src = '{address}'; }})"
            )
            refused = [text for text in browser.complaints() if "Content Security Policy" in text]
            assert len(refused) >= 2, browser.complaints()
        with pytest.raises(BlockingIOError):
            listening.accept()


EVIL = "</script><script>window.stolen = 1</script><img src=x onerror='window.stolen = 2'>"


def test_texts_of_user_files_are_shown_and_never_run(browser, folder, report):
    import dataclasses

    gait = dataclasses.replace(report.gait, name=EVIL, source=EVIL)
    evil = dataclasses.replace(report, gait=gait)
    for name, content in (("view", viewer.html(gait_scene(evil))), ("report", gait_page(evil))):
        file = folder / f"evil_{name}.html"
        file.write_bytes(content)
        browser.open(file.as_uri())
        browser.until("window.player && player.framesDrawn > 0")
        assert EVIL in browser.run("document.title")
        assert EVIL in browser.run("document.body.innerText")
        assert browser.run("typeof window.stolen") == "undefined"
        assert browser.complaints() == []
