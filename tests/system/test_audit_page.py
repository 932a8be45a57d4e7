"""The audits' pages in a real browser: all is searchable, linked, and drawn."""

import numpy as np
import pytest

from pollard_pin.thesis import catalogue as pollard_catalogue
from scout_pin.thesis.catalogue import catalogue as scout_catalogue
from thesis_pin.audit.documents.page import page
from thesis_pin.equations.uses import uses

pytestmark = pytest.mark.browser

SHOWN = "document.querySelectorAll('article:not([hidden])').length"


def search(browser, text):
    """Ids of the lines that the page's own search shows."""
    browser.page.fill("#find", text)
    return browser.run("[...document.querySelectorAll('article:not([hidden])')].map((x) => x.id)")


@pytest.fixture(scope="module")
def scout_page(tmp_path_factory, scout_audit):
    file = tmp_path_factory.mktemp("audit") / "scout.html"
    file.write_text(page(scout_audit, uses(scout_catalogue())), encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def pollard_page(tmp_path_factory, pollard_audit):
    file = tmp_path_factory.mktemp("audit") / "pollard.html"
    file.write_text(page(pollard_audit, uses(pollard_catalogue())), encoding="utf-8")
    return file


def test_the_page_opens_with_every_line_and_asks_nothing(
    browser, scout_page, scout_audit, artefacts
):
    for width, mobile in ((1280, False), (390, True)):
        browser.open(scout_page.as_uri(), width, 844, mobile)
        browser.until("document.readyState === 'complete'")
        assert browser.run(SHOWN) == len(scout_audit.rows)
        assert browser.run("document.documentElement.scrollWidth") <= width
        assert browser.requests() == [scout_page.as_uri()]
        assert browser.complaints() == []
        browser.run("document.getElementById('equations').scrollIntoView()")
        browser.still(artefacts / f"audit_{width}.png")


def test_both_searches_find_lines_that_hold(browser, scout_page, scout_audit):
    browser.open(scout_page.as_uri())
    browser.until("document.readyState === 'complete'")
    holds = {row.id for row in scout_audit.rows if "ZMP" in row.id and row.verdict == "holds"}
    assert holds
    assert browser.run("window.find('6.2:ZMP_x')")  # the browser's own, over what is laid out
    assert holds <= set(search(browser, "ZMP"))
    assert holds <= set(search(browser, "zmp holds"))
    assert len(search(browser, r"\dot{\theta}_{1i}")) > 0
    assert search(browser, "no such thing") == []
    assert len(search(browser, "")) == len(scout_audit.rows)


def test_an_anchor_leads_to_its_line_even_when_it_is_filtered_away(browser, scout_page):
    browser.open(f"{scout_page.as_uri()}#scout:4.1:L")
    browser.until("document.readyState === 'complete'")
    top = "document.querySelector(':target').getBoundingClientRect().top"
    assert browser.run("document.querySelector(':target').id") == "scout:4.1:L"
    assert 0 <= browser.until(top) < 720
    search(browser, "no such thing")
    browser.run("location.hash = '#scout:6.2:ZMP_x'")
    browser.until("!document.getElementById('scout:6.2:ZMP_x').hidden")
    assert 0 <= browser.run(top) < 720


def test_a_line_links_to_what_it_uses_and_what_uses_it(browser, scout_page):
    browser.open(scout_page.as_uri())
    browser.until("document.querySelector('article a[href=\"#scout:4.1:L\"]')")
    found = browser.run(
        "[...document.querySelectorAll('[id=\"scout:4.1:V_B\"] .links')].map((x) => x.textContent)"
    )
    used, users = found
    assert used.startswith("uses ")
    assert "4.1:b_B" in used.split()
    assert users.startswith("used by ")
    assert "4.1:L" in users.split()
    broken = browser.run(
        """[...document.links]
        .map((link) => decodeURIComponent(link.hash.slice(1)))
        .filter((id) => !document.getElementById(id))"""
    )
    assert broken == []


def test_what_is_wrong_is_coloured_in_the_print_of_lines_that_fail_and_nowhere_else(
    browser, pollard_page, pollard_audit
):
    browser.open(pollard_page.as_uri())
    browser.until("document.readyState === 'complete'")
    marked = browser.run(
        """[...document.querySelectorAll('article')].filter(
        (one) => one.querySelector('.f :is(.e, .be)')).map((one) => one.id)"""
    )
    assert 0.95 * len(pollard_audit.failures) < len(marked)
    assert set(marked) <= {row.id for row in pollard_audit.failures}
    (row,) = (row for row in pollard_audit.rows if row.id == "pollard:2.4.1:C_10")
    assert [slip.printed for slip in row.slips] == ["x_2"]
    shown = browser.run(
        """(() => { const one = document.getElementById('pollard:2.4.1:C_10');
        const colour = (of) => getComputedStyle(one.querySelector(of)).color;
        const marked = [...one.querySelectorAll('.f .e')].map((leaf) => leaf.textContent);
        return [...marked, colour('.f .e') === colour('.f mi')]; })()"""
    )
    assert shown == ["x₂", False]


def test_the_dot_of_a_rate_is_drawn_clear_of_its_letter(browser, pollard_page):
    browser.open(pollard_page.as_uri())
    browser.until("document.readyState === 'complete'")
    browser.run(
        """(() => { document.body.innerHTML = '<p style="font-size:60px;margin:30px" id=x></p>';
        document.getElementById('x').innerHTML =
          '<math><mover><mi>θ</mi><mn>˙</mn></mover></math>'; })()"""
    )
    box = browser.run(
        """(({x, y, width, height}) => [x, y, width, height])(
        document.querySelector('mover').getBoundingClientRect())"""
    )
    left, top, width, height = (round(value) for value in box)
    drawn = browser.still()[top : top + height, left : left + width].min(axis=-1) < 128
    rows = drawn.any(axis=1)
    runs = np.flatnonzero(np.diff(np.concatenate([[0], rows, [0]])) == 1)
    assert len(runs) == 2  # the dot, a gap, the letter


def test_pollards_page_stays_under_two_and_a_half_megabytes(pollard_page):
    assert pollard_page.stat().st_size < 2.5e6
