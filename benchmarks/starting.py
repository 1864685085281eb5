"""What it takes to install the workbook, and to open its first notebook."""

import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from statistics import median

from findings import Finding, ratio_of_medians, say
from mutants import NOT_COPIED
from playwright.sync_api import Browser
from round_trip import TOKEN, running_server

sys.path.append(str(Path(__file__).parent.parent))
sys.path.append(str(Path(__file__).parent.parent / "tests"))

from lab import PATIENCE_SECONDS, LabPage, running_browser, running_lab

from starter import download

ROOT = Path(__file__).resolve().parent.parent
FIRST = "00_start_here.ipynb"
WORK = "work-benchmark"
ROUNDS = 3
MOST_UV_MB, MOST_PIP_MB, MOST_FETCHED_MB = 480, 660, 140


def measure_install() -> list[Finding]:
    """Install what a learner needs, with uv and with pip, and fetch it once more to weigh it."""
    with tempfile.TemporaryDirectory() as folder:
        by_uv, by_pip, fetched = (Path(folder) / name for name in ("uv", "pip", "fetched"))
        findings = []
        if shutil.which("uv"):
            install(by_uv, os.environ["PATH"])
            findings.append(Finding("a .venv made with uv", weight(by_uv), MOST_UV_MB, "MB"))
        install(by_pip, without_uv())
        pins = [name + pin for name, pin, _ in download.entries(whole=False)]
        python = str(by_pip / ".venv" / "bin" / "python")
        fetch = [python, "-m", "pip", "download", "--quiet", "--no-deps", "-d", str(fetched)]
        subprocess.run([*fetch, *pins], check=True, stdout=sys.stderr)
        return [
            *findings,
            Finding("a .venv made with pip", weight(by_pip), MOST_PIP_MB, "MB"),
            Finding("  : fetched for it", weight(fetched), MOST_FETCHED_MB, "MB"),
        ]


def install(folder: Path, path: str) -> None:
    """Set up a copy of the workbook, with the programs of this PATH."""
    shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(*NOT_COPIED))
    command = [sys.executable, str(folder / "workbook.py"), "setup"]
    subprocess.run(command, check=True, env=os.environ | {"PATH": path}, stdout=sys.stderr)


def without_uv() -> str:
    """Return the PATH less the folders that have uv."""
    folders = os.environ["PATH"].split(os.pathsep)
    return os.pathsep.join(one for one in folders if not shutil.which("uv", path=one))


def weight(folder: Path) -> float:
    """Return what the files of an environment, or of a folder without one, weigh in MB."""
    root = folder / ".venv" if (folder / ".venv").exists() else folder
    files = (path for path in root.rglob("*") if path.is_file() and not path.is_symlink())
    return sum(path.stat().st_size for path in files) / 1e6


def measure_start() -> list[Finding]:
    """Start the workbook, and a plain JupyterLab, by turns, until the notebook's kernel answers."""
    own: list[float] = []
    plain: list[float] = []
    with running_browser() as browser, tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        shutil.copy(ROOT / "notebooks" / FIRST, home)
        config = {
            "ServerApp": {"root_dir": folder},
            "LabApp": {"expose_app_in_browser": True},
        }
        try:
            seconds_to_notebook(browser, lambda: running_lab(home, WORK))  # what is made once
            for _ in range(ROUNDS):
                own.append(seconds_to_notebook(browser, lambda: running_lab(home, WORK)))
                plain.append(seconds_to_notebook(browser, lambda: running_server(config), TOKEN))
        finally:
            shutil.rmtree(ROOT / WORK, ignore_errors=True)
    say(f"medians: {median(own):.1f} s and {median(plain):.1f} s")
    what = "from the command to a notebook : the same with jupyter lab"
    return [Finding(what, ratio_of_medians(own, plain), 1.2, "x")]


def seconds_to_notebook(
    browser: Browser, start: Callable[[], AbstractContextManager[str]], token: str = ""
) -> float:
    """Return how long it takes from a server's start until the first notebook can be run."""
    started = time.perf_counter()
    with start() as address:
        if token:
            wait_for_server(address)
            address = f"http://{address}/lab/tree/{FIRST}?token={token}"
        page = LabPage(browser, address)
        page.wait_for(FIRST)
        spent = time.perf_counter() - started
        page.page.context.close()
    return spent


def wait_for_server(address: str) -> None:
    """Wait until somebody listens there."""
    host, _, port = address.partition(":")
    end = time.monotonic() + PATIENCE_SECONDS
    while True:
        try:
            socket.create_connection((host, int(port)), timeout=1).close()
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(0.05)
        else:
            return
