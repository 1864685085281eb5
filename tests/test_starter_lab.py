"""JupyterLab: its port, its start and end, and the browser."""

import io
import os
import secrets
import signal
import socket
import subprocess
import sys
import threading
from http import HTTPStatus
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest
from small_workbook import move_starter

from starter import browser, commands, environment, lab, processes
from starter.errors import WorkbookError

OWN_SETTINGS = """
c.IdentityProvider.token = "mine"
c.PasswordIdentityProvider.hashed_password = "sha1:0123:4567"
c.ServerApp.certfile = "/no/such/certificate.pem"
c.ServerApp.base_url = "/mine/"
"""
SCREENS = ("SSH_CONNECTION", "DISPLAY", "WAYLAND_DISPLAY")


@pytest.fixture(autouse=True)
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a small workbook, with the environment that runs the tests."""
    root = move_starter(tmp_path, monkeypatch)
    monkeypatch.setattr(lab, "VENV_PYTHON", Path(sys.executable))
    monkeypatch.setattr(environment, "ensure", lambda: None)
    return root


def test_a_busy_port_is_avoided_or_refused(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The default port gives way in words; a port that was asked for does not."""
    with socket.socket() as busy:
        busy.bind(("127.0.0.1", 0))
        busy.listen()
        port = busy.getsockname()[1]
        monkeypatch.setattr(lab, "DEFAULT_PORT", port)
        assert lab.choose_port(None) > port
        assert f"Port {port} is in use" in capsys.readouterr().out
        with pytest.raises(WorkbookError, match=f"Port {port} is in use"):
            lab.choose_port(port)
    assert lab.choose_port(port) == port


def test_a_port_whose_connections_just_closed_is_free() -> None:
    """A lab that has just stopped leaves such a port behind; the next one takes it again."""
    with socket.socket() as server:
        server.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        server.bind(("127.0.0.1", 0))
        server.listen()
        port = server.getsockname()[1]
        with socket.create_connection(("127.0.0.1", port)):
            connection, _ = server.accept()
            connection.close()  # the server's side first, so that it is the one that waits
    assert lab.is_free(port)


def test_the_lab_opens_and_ends(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It answers with its token, not without, whatever the learner has set, and ends by Ctrl-C."""
    start = lab.start

    def start_and_press_ctrl_c(
        port: int, token: str, served: Path, passed_on: list[str]
    ) -> "subprocess.Popen[str]":
        process = start(port, token, served, passed_on)
        watchdog = threading.Timer(30, process.kill)
        watchdog.daemon = True
        watchdog.start()
        assert lab.ask(port, token) == HTTPStatus.OK
        assert lab.ask(port, "wrong") == lab.ask(port, "mine") == HTTPStatus.FORBIDDEN
        assert token not in str(process.args)
        process.send_signal(signal.SIGINT)
        return process

    # A test run in the background ignores Ctrl-C, and JupyterLab would inherit that.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    monkeypatch.setattr(lab, "start", start_and_press_ctrl_c)
    for name in ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR"):
        monkeypatch.setenv(name, str(tmp_path / name))
    (tmp_path / "JUPYTER_CONFIG_DIR").mkdir()
    (tmp_path / "JUPYTER_CONFIG_DIR" / "jupyter_server_config.py").write_text(OWN_SETTINGS)
    (tmp_path / "astray").mkdir()
    (tmp_path / "astray" / "jupyterlab.py").write_text("raise SystemExit('led astray')")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "astray"))
    port = free_port()
    try:
        assert commands.run(["--no-browser", f"--port={port}", "--work=work-anna"]) == 0
    finally:
        signal.signal(signal.SIGINT, before)
    said = capsys.readouterr().out
    assert f"JupyterLab is ready: http://127.0.0.1:{port}/lab/tree/work-anna/00_start" in said
    assert said.endswith("\nJupyterLab has stopped. Your copies are in work-anna/.\n")
    assert lab.is_free(port)


def free_port() -> int:
    """Return a port that nobody uses."""
    with socket.socket() as chosen:
        chosen.bind(("127.0.0.1", 0))
        return int(chosen.getsockname()[1])


def let_lab_be(monkeypatch: pytest.MonkeyPatch, script: str) -> None:
    """Start this script instead of JupyterLab."""
    command = [sys.executable, "-c", script]
    monkeypatch.setattr(lab, "command", lambda *_arguments: command)


@pytest.mark.parametrize(
    ("told", "why"),
    [
        ("no such option", "$"),
        ("No space left on device", r" The disk is full\. Make room and start again\.$"),
        ("Connection refused", "$"),  # by no package index
    ],
)
def test_a_lab_that_dies_shows_its_last_words(
    monkeypatch: pytest.MonkeyPatch, told: str, why: str
) -> None:
    """A start that fails does not hang, and says why where that is known."""
    let_lab_be(monkeypatch, f"raise SystemExit({told!r})")
    with pytest.raises(WorkbookError, match=rf"{told}\n.*before it was ready\.{why}"):
        lab.start(8888, "token", Path(), [])


@pytest.mark.parametrize(
    ("status", "words"),
    [
        (HTTPStatus.FORBIDDEN, "refuses the token .* JUPYTER_CONFIG_DIR"),
        (HTTPStatus.UNAUTHORIZED, "refuses the token .* JUPYTER_CONFIG_DIR"),
        (HTTPStatus.BAD_GATEWAY, "answers only with status 502 on port 8888 after 0 s"),
        (lab.NO_ANSWER, "does not answer on port 8888 after 0 s.* firewall"),
    ],
)
def test_a_lab_that_never_gets_ready_is_not_waited_for_without_end(
    monkeypatch: pytest.MonkeyPatch, status: int, words: str
) -> None:
    """What refuses, or stays silent too long, is ended with a sentence."""
    ended: list[subprocess.Popen[str]] = []
    stop = processes.stop

    def note_and_stop(child: "subprocess.Popen[str]") -> None:
        ended.append(child)
        stop(child)

    let_lab_be(monkeypatch, "import time; time.sleep(60)")
    monkeypatch.setattr(lab, "ask", lambda _port, _token: status)
    monkeypatch.setattr(lab, "PATIENCE", 0 if status not in lab.REFUSED else 60)
    monkeypatch.setattr(processes, "stop", note_and_stop)
    with pytest.raises(WorkbookError, match=words):
        lab.start(8888, "token", Path(), [])
    assert ended[0].returncode is not None


def test_what_leads_python_astray_does_not_reach_a_child(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Packages of another place would come before those of the environment, in each kernel."""
    for name in processes.ASTRAY:
        monkeypatch.setenv(name, "astray")
    monkeypatch.setenv("MINE", "stays")
    let_lab_be(monkeypatch, "import os; raise SystemExit(str(dict(os.environ)))")
    with pytest.raises(WorkbookError) as caught:
        lab.start(8888, "token", Path(), [])
    assert "astray" not in str(caught.value)
    assert {"PYTHONPATH", "PYTHONHOME"} == {*processes.ASTRAY}
    assert processes.environ(MORE="1") == {
        name: value for name, value in os.environ.items() if value != "astray"
    } | {"MORE": "1"}


def test_a_lab_that_dies_later_is_not_said_to_have_been_stopped(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its exit code is passed on."""
    let_lab_be(monkeypatch, "import time; time.sleep(0.2); raise SystemExit(3)")
    monkeypatch.setattr(lab, "ask", lambda _port, _token: HTTPStatus.OK)
    assert commands.run(["--no-browser"]) == 3
    assert "has stopped" not in capsys.readouterr().out


def test_the_token_stays_off_the_browsers_command_line(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The browser is given a page in a folder of our own, gone in the end, that leads on."""
    pages = []

    def open_page(address: str) -> bool:
        page = Path(
            unquote(urlsplit(address).path.removeprefix("/" if sys.platform == "win32" else ""))
        )
        assert page.is_relative_to(root / "work")
        assert sys.platform == "win32" or page.parent.stat().st_mode & 0o777 == 0o700
        pages.append((address, page.read_text()))
        return True

    let_lab_be(monkeypatch, "import time; time.sleep(0.2)")
    monkeypatch.setattr(lab, "ask", lambda _port, _token: HTTPStatus.OK)
    monkeypatch.setattr(browser, "find_obstacle", lambda _no_browser: "")
    monkeypatch.setattr("webbrowser.open", open_page)
    monkeypatch.setattr(secrets, "token_hex", lambda _length: "secret")
    assert commands.run([]) == 0
    ((address, page),) = pages
    url = capsys.readouterr().out.split("ready: ")[1].split()[0]
    assert url.endswith("?token=secret")
    assert url in page
    assert "secret" not in address
    assert sorted(path.suffix for path in (root / "work").iterdir()) == [".ipynb", ".ipynb"]


@pytest.mark.parametrize(
    ("variables", "words"),
    [
        ({"SSH_CONNECTION": "a 1 b 22", "DISPLAY": ":0"}, "SSH"),
        ({"DISPLAY": ":0"}, ""),
        ({"WAYLAND_DISPLAY": "wayland-0"}, ""),
        pytest.param(
            {},
            "no screen",
            marks=pytest.mark.skipif(sys.platform != "linux", reason="X11, Wayland"),
        ),
    ],
)
def test_a_browser_is_opened_where_there_is_one(
    monkeypatch: pytest.MonkeyPatch, variables: dict[str, str], words: str
) -> None:
    """Not over SSH and not without a screen, and this is said."""
    for name in SCREENS:
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    obstacle = browser.find_obstacle(no_browser=False)
    assert words in obstacle if words else not obstacle


@pytest.mark.parametrize("is_terminal", [True, False])
@pytest.mark.parametrize("on_windows", [True, False])
def test_how_to_stop_is_said_as_the_lab_asks(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    is_terminal: bool,
    on_windows: bool,
) -> None:
    """In a terminal it asks for a yes, but not on Windows; whatever else starts it is not asked."""
    monkeypatch.setattr("sys.stdin", io.StringIO())
    monkeypatch.setattr("sys.stdin.isatty", lambda: is_terminal)
    monkeypatch.setattr(browser, "ON_WINDOWS", on_windows)
    browser.welcome("http://127.0.0.1:8888/lab", 8888, True, tmp_path)
    said = "Ctrl-C, then y" if is_terminal and not on_windows else "Ctrl-C"
    assert f"lab (stop it with {said})\n" in capsys.readouterr().out


@pytest.mark.parametrize("is_far", [True, False])
def test_how_to_open_it_from_afar_is_said_in_a_session_of_ssh(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    is_far: bool,
) -> None:
    monkeypatch.delenv("SSH_CONNECTION", raising=False)
    if is_far:
        monkeypatch.setenv("SSH_CONNECTION", "192.0.2.1 50000 192.0.2.2 22")
    browser.welcome("http://127.0.0.1:8888/lab", 8888, True, tmp_path)
    assert ("ssh -L 8888:127.0.0.1:8888" in capsys.readouterr().out) == is_far


@pytest.mark.parametrize(
    ("names", "page"),
    [(["01_one.ipynb", "02_two.ipynb"], "/lab/tree/w/01_one.ipynb"), ([], "/lab")],
)
def test_where_notebook_00_is_not_the_next_one_is_the_first_page(
    monkeypatch: pytest.MonkeyPatch, names: list[str], page: str
) -> None:
    monkeypatch.setattr("starter.notebooks.originals", lambda: [*map(Path, names)])
    assert browser.first_page("w") == page
