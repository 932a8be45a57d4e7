"""A browser opens only where it has a window to open in; elsewhere the user is told the way."""

import webbrowser

import pytest

from thesis_pin.pages.browser import TEXT_BROWSERS, directions, graphical

DISPLAY = {"DISPLAY": ":0"}


@pytest.fixture
def finds(monkeypatch):
    """Makes the standard library find this browser."""

    def choose(browser):
        monkeypatch.setattr("sys.platform", "linux")
        monkeypatch.setattr(webbrowser, "get", lambda: browser)
        return browser

    return choose


def test_a_browser_with_a_window_is_taken(finds):
    firefox = finds(webbrowser.BackgroundBrowser("firefox"))
    assert graphical(DISPLAY) is firefox
    assert graphical({"WAYLAND_DISPLAY": "wayland-0"}) is firefox


@pytest.mark.parametrize("environment", [{}, {"DISPLAY": ""}])
def test_without_a_display_none_is_taken(finds, environment):
    finds(webbrowser.BackgroundBrowser("firefox"))
    assert graphical(environment) is None


@pytest.mark.parametrize("variable", ["SSH_CONNECTION", "SSH_TTY"])
def test_over_ssh_none_is_taken_with_a_forwarded_display_either(finds, variable):
    finds(webbrowser.BackgroundBrowser("firefox"))
    assert graphical({**DISPLAY, variable: "10.0.0.2 50000 10.0.0.1 22"}) is None


@pytest.mark.parametrize("name", [*TEXT_BROWSERS, "/usr/bin/w3m"])
def test_a_text_browser_never_gets_the_terminal(finds, name):
    finds(webbrowser.GenericBrowser(name))
    assert graphical(DISPLAY) is None


def test_a_program_that_the_user_named_is_not_waited_for(finds):
    finds(webbrowser.GenericBrowser(["/opt/helper.sh", "%s"]))
    browser = graphical(DISPLAY)
    assert isinstance(browser, webbrowser.BackgroundBrowser)
    assert (browser.name, browser.args) == ("/opt/helper.sh", ["%s"])


def test_every_port_that_a_page_needs_is_forwarded():
    told = directions("127.0.0.1", 7000, {"SSH_CONNECTION": "10.0.0.2 5 10.0.0.1 22"}, also=[7001])
    assert "ssh -L 7000:127.0.0.1:7000 -L 7001:127.0.0.1:7001 " in told


def test_a_machine_without_any_browser_is_no_error(monkeypatch):
    def none():
        raise webbrowser.Error("could not locate runnable browser")

    monkeypatch.setattr(webbrowser, "get", none)
    assert graphical(DISPLAY) is None


def test_the_ssh_line_names_the_machine_and_port_one_came_through(monkeypatch):
    monkeypatch.setattr("getpass.getuser", lambda: "ada")
    text = directions("127.0.0.1", 7003, {"SSH_CONNECTION": "10.0.0.2 50000 192.0.2.7 2222"})
    assert text.endswith("\n  ssh -L 7003:127.0.0.1:7003 -p 2222 ada@192.0.2.7")
    text = directions("127.0.0.1", 7003, {"SSH_CONNECTION": "fe80::1 50000 fe80::2 22"})
    assert text.endswith(" 7003:127.0.0.1:7003 ada@fe80::2")


def test_what_an_environment_says_reaches_no_terminal_raw(monkeypatch):
    def nobody():
        raise KeyError("getpwuid(): uid not found: 12345")

    monkeypatch.setattr("getpass.getuser", nobody)
    monkeypatch.setattr("socket.gethostname", lambda: "lab")
    text = directions("127.0.0.1", 7000, {"SSH_CONNECTION": "\x1b[2J x \x1b]0;y\x07 22"})
    assert text.endswith("ssh -L 7000:127.0.0.1:7000 USER@lab")
    monkeypatch.setattr("getpass.getuser", lambda: "\x1b[2J")
    assert "\x1b" not in directions("127.0.0.1", 7000, {})
