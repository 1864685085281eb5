"""Every notebook in Chromium and Firefox, in JupyterLab and Notebook 7, walked from end to end."""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager, suppress
from pathlib import Path

from findings import Finding, say
from live import ROOT

sys.path += [str(ROOT / "tests"), str(ROOT)]

from firefox import running_firefox
from hub import Account, running_hub
from hub_environment import installed
from hub_lesson import make_course
from lab import (
    PATIENCE_SECONDS,
    free_port,
    own_folders,
    running_browser,
    running_lab,
    wait_for_address,
)
from playwright.sync_api import Error
from walking import Walk
from windows import ChromiumWindow, Window

WORK = "work-benchmark"
NOTEBOOK = "notebook>=7.6,<7.7"  # that of JupyterLab 4.6; it is no part of the workbook
START = "00_start_here.ipynb"
READY = r"(http://127\.0\.0\.1:\d+/tree\?token=\S+)"
ROW = "{:<9} {:<11} {:<3} {:>5} {:>6} {:>9} {:>8}"
HEADINGS = ("browser", "front end", "nb", "moved", "played", "seconds", "findings")
TEN = 10
EXPOSED = 'c.Spawner.args += ["--LabApp.expose_app_in_browser=True"]'
FRONT_END_BY = {"/user/": "JupyterHub", "/lab/": "JupyterLab", "": "Notebook 7"}
"""What an address shows of its front end."""


def measure_browsers() -> list[Finding]:
    """Walk through every notebook: two browsers, JupyterLab and Notebook 7 (asks PyPI for it)."""
    return [finding for place in PLACES for finding in _walk_all(*place, rounds=1)]


def measure_browsers_ten() -> list[Finding]:
    """Walk through every notebook ten times in JupyterLab and Chromium: nothing may be chance."""
    return _walk_all("Chromium", "JupyterLab", rounds=TEN)


def measure_browsers_hub() -> list[Finding]:
    """Walk through every notebook as students of a hub who log in, in each browser (needs root)."""
    say(ROW.format(*HEADINGS))
    findings = []
    with (
        tempfile.TemporaryDirectory() as folder,
        running_hub(installed(), make_course(Path(folder)), len(BROWSERS), more=EXPOSED) as hub,
    ):
        for browser, student in zip(BROWSERS, hub.accounts, strict=True):
            profile = Path(folder) / browser
            profile.mkdir()
            with BROWSERS[browser](profile) as window:
                _log_in(window, hub.link, student)
                for name in _names():
                    address = f"{hub.address}/user/{student.name}/lab/tree/cam-class/{name}?"
                    found = _walk(window, address, f"cam-class/{name}")
                    what = f"{browser}, JupyterHub: findings in {name[:2]}"
                    findings.append(Finding(what, len(found), 0, ""))
    return findings


def _log_in(window: Window, link: str, student: Account) -> None:
    """Follow the teacher's link, type name and password, and wait for the notebook."""
    window.goto(link)
    for field, text in (("username", student.name), ("password", student.password)):
        window.evaluate("name => document.getElementsByName(name)[0].focus()", field)
        for key in text:
            window.press(key)
    window.press("Enter")
    end = time.monotonic() + PATIENCE_SECONDS
    while "/lab/tree/" not in _place(window):
        if time.monotonic() > end:
            raise TimeoutError(f"No notebook after {PATIENCE_SECONDS} s: {_place(window)}")
        time.sleep(0.1)


def _place(window: Window) -> str:
    """Return where a page is; nothing while it goes from one to the next."""
    with suppress(RuntimeError, Error):  # Firefox's, and Playwright's
        return str(window.evaluate("() => location.pathname"))
    return ""


@contextmanager
def running_notebook(home: Path, work: str) -> Iterator[str]:
    """Start Notebook 7 on the learner's copies, beside the workbook's environment."""
    laid = [sys.executable, str(ROOT / "workbook.py"), "setup", "--work", work]
    subprocess.run(laid, check=True, stdout=sys.stderr)
    installed = home / "notebook"
    uv, python = shutil.which("uv"), sys.executable  # uv makes a .venv that has no pip in it
    install = [uv, "pip", "install", "-p", python] if uv else [python, "-m", "pip", "install"]
    wanted = ["--quiet", "--no-deps", NOTEBOOK, "--target", str(installed)]
    subprocess.run([*install, *wanted], check=True, stdout=sys.stderr)
    app = installed / "share/jupyter/lab"  # JupyterLab's schemas beside those of Notebook 7
    for part in ("schemas", "themes"):
        own = Path(sys.prefix) / "share/jupyter/lab" / part
        shutil.copytree(own, app / part, dirs_exist_ok=True)
    log = home / "notebook.log"
    with log.open("w") as output:
        server = subprocess.Popen(
            [
                *(sys.executable, "-m", "notebook", "--no-browser", "--allow-root"),
                *(f"--port={free_port()}", "--ServerApp.ip=127.0.0.1"),
                *(f"--ServerApp.root_dir={ROOT}", "--ServerApp.port_retries=0"),
                "--JupyterNotebookApp.expose_app_in_browser=True",
            ],
            env=os.environ
            | own_folders(home)
            | {
                "PYTHONPATH": os.pathsep.join([str(installed), str(ROOT / "src")]),
                "JUPYTERLAB_DIR": str(app),
                "JUPYTER_PATH": str(installed / "share/jupyter"),
                "JUPYTER_CONFIG_PATH": str(installed / "etc/jupyter"),
            },
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
        )
    try:
        address = wait_for_address(server, log, READY)
        yield address.replace("/tree?", f"/notebooks/{work}/{START}?")
    finally:
        server.terminate()
        server.wait(60)


@contextmanager
def _in_chromium(_: Path) -> Iterator[Window]:
    with running_browser() as browser:
        yield ChromiumWindow(browser)


FRONT_ENDS = {"JupyterLab": running_lab, "Notebook 7": running_notebook}
BROWSERS: dict[str, Callable[[Path], AbstractContextManager[Window]]] = {
    "Chromium": _in_chromium,
    "Firefox": running_firefox,
}
PLACES = [(browser, front_end) for browser in BROWSERS for front_end in FRONT_ENDS]


def _walk_all(browser: str, front_end: str, *, rounds: int) -> list[Finding]:
    """Walk through all notebooks so many times; return how much was found wrong in each."""
    names = _names()
    wrong = dict.fromkeys(names, 0)
    say(ROW.format(*HEADINGS))
    for _ in range(rounds):
        with ExitStack() as stack:
            folder = stack.enter_context(tempfile.TemporaryDirectory())
            address = stack.enter_context(_workbook(Path(folder), front_end))
            for name in names:
                profile = Path(folder) / f"{browser}-{name}"
                profile.mkdir()
                with BROWSERS[browser](profile) as window:
                    found = _walk(window, address.replace(START, name), f"{WORK}/{name}")
                wrong[name] += len(found)
    what = f"{browser}, {front_end}" + f", {rounds} rounds" * (rounds > 1)
    return [Finding(f"{what}: findings in {name[:2]}", wrong[name], 0, "") for name in names]


def _names() -> list[str]:
    return sorted(path.name for path in (ROOT / "notebooks").glob("[0-9]*.ipynb"))


@contextmanager
def _workbook(home: Path, front_end: str) -> Iterator[str]:
    try:
        with FRONT_ENDS[front_end](home, WORK) as address:
            yield address
    finally:
        shutil.rmtree(ROOT / WORK, ignore_errors=True)


def _walk(window: Window, address: str, path: str) -> list[str]:
    """Walk through a notebook, say how it went, and return what was found."""
    began = time.monotonic()
    walk = Walk(window, f"{address}&reset", path)
    try:
        walk.take()
    except Exception as error:  # the others are walked through all the same
        walk.findings.append(f"not to its end: {str(error)[:200]}")
    seconds = time.monotonic() - began
    played = walk.moved.pop("clock", 0)
    browser = type(window).__name__.removesuffix("Window").removesuffix("Page")
    front_end = next(name for part, name in FRONT_END_BY.items() if part in address)
    counts = (walk.moved.total(), played, f"{seconds:.0f}", len(walk.findings))
    say(ROW.format(browser, front_end, Path(path).name[:2], *counts))
    for finding in walk.findings:
        say(f"    {finding[:200]}")
    return walk.findings
