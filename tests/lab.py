"""A real JupyterLab, started as the README says, in a real Chromium.

Shared by the browser test and the benchmarks.
"""

import os
import re
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator, Page, sync_playwright
from windows import ChromiumWindow, complaints

ROOT = Path(__file__).parent.parent
START = "00_start_here.ipynb"  # which the starter opens
PATIENCE_SECONDS = 180  # a machine may be busy with much else
CHROMIUM = ("chromium", "chromium-browser", "google-chrome")
CHROMIUM_FLAGS = [
    "--no-sandbox",  # it is not available to root; all pages are our own
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
# The toolbar says "idle" before the session is ready, and what is asked for then is lost.
READY = """async name => {
  const notebook = () => window.jupyterapp?.shell.currentWidget?.context;
  while (!notebook()?.path.endsWith(name)) await new Promise(r => setTimeout(r, 50));
  await notebook().ready;
  await notebook().sessionContext.ready;
  await notebook().sessionContext.session.kernel.info;
}"""
COMMAND = "async name => { await jupyterapp.commands.execute(name); }"
# With what a learner would be asked answered: nothing is to be saved, and nobody comes back.
CLOSE = """async () => {
  const { currentWidget } = jupyterapp.shell, { model, sessionContext } = currentWidget.context;
  await sessionContext.shutdown();
  model.dirty = false;
  currentWidget.close();
}"""
OPEN = """async path => {
  await jupyterapp.commands.execute("docmanager:open", { path, factory: "Notebook" });
}"""
IN_TIME = """name => Promise.race([
  (%s)(name),
  new Promise((_, fail) => setTimeout(() => fail(`no end of ${name} in %d s`), %d * 1000))
])"""
TROUBLE = (
    "[data-mime-type='application/vnd.jupyter.error'], "
    "[data-mime-type='application/vnd.jupyter.stderr'], "
    ".jp-OutputArea-output:text-matches('Error displaying widget|Loading widget')"
)


def find_chromium() -> str | None:
    """Return the path of a Chromium or Chrome, if there is one."""
    return next(filter(None, map(shutil.which, CHROMIUM)), None)


def require_chromium() -> None:
    """Skip where there is no Chromium, unless a browser is what somebody asked for."""
    require_browser(CHROMIUM)


def require_browser(names: Sequence[str]) -> str:
    """Return the path of the first of these that there is; without one say what is not tested."""
    if path := next(filter(None, map(shutil.which, names)), None):
        return path
    reason = f"NOT TESTED in a browser: none of {', '.join(names)} is on the PATH"
    if os.environ.get("REQUIRE_BROWSER") == "1":
        pytest.fail(reason)
    pytest.skip(reason)


@contextmanager
def running_lab(home: Path, work: str) -> Iterator[str]:
    """Start the workbook's JupyterLab and give the address that it prints.

    JupyterLab keeps its own files in `home`, the learner's copies are in the folder `work`.
    """
    port = free_port()
    command = [sys.executable, str(ROOT / "workbook.py"), "--no-browser", "--port", str(port)]
    command += ["--work", work, "--", "--LabApp.expose_app_in_browser=True"]
    log = home / f"lab-{port}.log"
    with log.open("w") as output:
        lab = subprocess.Popen(
            command,
            env=os.environ | own_folders(home),
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
        )
    try:
        yield wait_for_address(lab, log, r"JupyterLab is ready: (\S+)")
    finally:
        lab.terminate()
        lab.wait(PATIENCE_SECONDS)


def free_port() -> int:
    """Return a port that nobody uses."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def own_folders(home: Path) -> dict[str, str]:
    """Return the environment that keeps JupyterLab's files in `home`."""
    return {
        "JUPYTER_CONFIG_DIR": str(home / "config"),
        "JUPYTER_DATA_DIR": str(home / "data"),
        "JUPYTER_RUNTIME_DIR": str(home / "runtime"),
        "JUPYTERLAB_SETTINGS_DIR": str(home / "settings"),
        "JUPYTERLAB_WORKSPACES_DIR": str(home / "workspaces"),
    }


def wait_for_address(program: "subprocess.Popen[bytes]", log: Path, line: str) -> str:
    """Return the address that a program prints, in a line like this, when it is ready."""
    end = time.monotonic() + PATIENCE_SECONDS
    while time.monotonic() < end and program.poll() is None:
        if found := re.search(line, log.read_text("utf-8", errors="replace")):
            return found[1]
        time.sleep(0.1)
    raise RuntimeError(f"{program.args!r} is not ready:\n{log.read_text('utf-8', 'replace')}")


@contextmanager
def running_browser() -> Iterator[Browser]:
    """Start Chromium."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=find_chromium(), args=CHROMIUM_FLAGS, timeout=PATIENCE_SECONDS * 1000
        )
        yield browser
        browser.close()


@contextmanager
def calm(browser: Browser) -> Iterator[Browser]:
    """Start another Chromium, of a reader whose system says that little should move.

    What Playwright emulates instead does not reach into an image.
    """
    flags = [*CHROMIUM_FLAGS, "--force-prefers-reduced-motion"]
    started = browser.browser_type.launch(executable_path=find_chromium(), args=flags)
    yield started
    started.close()


@contextmanager
def opened_notebook(
    browser: Browser, home: Path, work: str, name: str = START
) -> Iterator["LabPage"]:
    """Open a notebook by the starter's address, in which it stands for 00; do not run it."""
    try:
        with running_lab(home, work) as address:
            lab = LabPage(browser, address.replace(START, name), work)
            lab.wait_for(name)
            yield lab
    finally:
        shutil.rmtree(ROOT / work, ignore_errors=True)


def type_into(field: Locator, words: str) -> None:
    """Go to a field and put something else into it: out of sight its text cannot be selected."""
    field.scroll_into_view_if_needed()
    field.fill(words)
    field.press("Enter")


class LabPage:
    """JupyterLab in a page of its own; what goes wrong there is collected in `complaints`.

    The learner's copies are in the folder `work`; without it no other notebook can be opened.
    """

    def __init__(self, browser: Browser, address: str, work: str = "") -> None:
        self.address, self.work = address, work
        self.window = ChromiumWindow(browser)
        self.page: Page = self.window.page
        self.page.set_default_timeout(PATIENCE_SECONDS * 1000)
        self.window.goto(address)

    @property
    def complaints(self) -> list[str]:
        """What went wrong in the page, or was asked from elsewhere."""
        return complaints(self.window, self.address)

    def _await(self, script: str, name: str) -> None:
        self.page.evaluate(IN_TIME % (script, PATIENCE_SECONDS, PATIENCE_SECONDS), name)

    def wait_for(self, notebook: str) -> None:
        """Wait until this notebook is in front and its kernel ready."""
        self._await(READY, notebook)

    def open(self, notebook: str) -> None:
        """Open another notebook in place of the one in front, whose kernel ends."""
        self._await(CLOSE, "the notebook in front")
        self.window.errors.clear()  # of what was asked of a kernel that has ended
        self.window.asked.clear()
        self._await(OPEN, f"{self.work}/{notebook}")
        self.wait_for(notebook)

    def command(self, name: str) -> None:
        """Run a command of JupyterLab to its end."""
        self._await(COMMAND, name)

    def reload(self, notebook: str) -> None:
        """Load the page anew, with this notebook in front."""
        self.page.reload(wait_until="domcontentloaded")
        self.wait_for(notebook)

    def settle(self) -> None:
        """Give the page and the kernel time for what they have to say to each other."""
        self.page.wait_for_timeout(500)

    def troubles(self) -> list[str]:
        """Return what a learner would see of errors in the outputs."""
        return [text.strip() for text in self.notebook.locator(TROUBLE).all_text_contents()]

    @property
    def notebook(self) -> Locator:
        """The notebook in front."""
        return self.page.locator(".jp-NotebookPanel:not(.lm-mod-hidden)")

    def output_of(self, source: str) -> Locator:
        """Return the output area of the cell whose source contains `source`."""
        cell = self.notebook.locator(".jp-CodeCell", has_text=source)
        return cell.locator(".jp-Cell-outputArea")
