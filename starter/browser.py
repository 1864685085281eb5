"""Say where JupyterLab is, and show it where there is a browser to show it in."""

import contextlib
import os
import re
import sys
import tempfile
import time
import webbrowser
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from urllib.parse import quote

from starter import notebooks
from starter.paths import ON_WINDOWS

FIRST_NOTEBOOK = "00_start_here.ipynb"
PAGE = "open.html"
PRIVATE, PRIVATE_NAME = ".lab-page-", re.compile(r"\.lab-page-\w{8}")
SECONDS_OF_USE = 60  # a browser opens its page at once, or never
REDIRECT = """<!DOCTYPE html>
<title>JupyterLab</title>
<meta http-equiv="refresh" content="0; url={url}">
<p><a href="{url}">Open JupyterLab</a></p>
"""


def first_page(folder: str) -> str:
    """Return the address, within the server, of the page to begin with, in the copies' folder."""
    names = [path.name for path in notebooks.originals()]
    first = FIRST_NOTEBOOK if FIRST_NOTEBOOK in names else next(iter(names), "")
    return quote(str(PurePosixPath("/lab/tree", folder, first)) if first else "/lab")


@contextlib.contextmanager
def private_folder(work: Path) -> Iterator[Path]:
    """Make a folder that only the user may look into; what a killed start left of one goes."""
    for left_over in work.glob(f"{PRIVATE}*"):
        if PRIVATE_NAME.fullmatch(left_over.name):
            with contextlib.suppress(OSError):
                if time.time() - left_over.stat().st_mtime > SECONDS_OF_USE:
                    (left_over / PAGE).unlink(missing_ok=True)
                    left_over.rmdir()
    with tempfile.TemporaryDirectory(prefix=PRIVATE, dir=work, ignore_cleanup_errors=True) as made:
        yield Path(made)


def welcome(url: str, port: int, no_browser: bool, private: Path) -> None:
    """Say where JupyterLab is, and show it; only the user may look into the folder `private`."""
    how = "Ctrl-C, then y" if sys.stdin.isatty() and not ON_WINDOWS else "Ctrl-C"
    print(f"JupyterLab is ready: {url} (stop it with {how})")
    obstacle = find_obstacle(no_browser)
    if not obstacle and not show(url, private):
        obstacle = "No browser could be started."
    if obstacle:
        print(f"{obstacle} Open the address above yourself.")
    if "SSH_CONNECTION" in os.environ:
        print(
            "To open it on your own computer, log in from there with "
            f"`ssh -L {port}:127.0.0.1:{port} ...` first."
        )


def find_obstacle(no_browser: bool) -> str:
    """Say why no browser is opened here; nothing if one is."""
    if no_browser:
        return "No browser is opened, as you asked."
    if "SSH_CONNECTION" in os.environ:
        return "No browser is opened in an SSH session."
    if sys.platform == "linux" and not {"DISPLAY", "WAYLAND_DISPLAY"} & os.environ.keys():
        return "No browser is opened, since there is no screen."
    return ""


def show(url: str, private: Path) -> bool:
    """Open a page that leads on to the address: its token must not stand on a command line."""
    page = private / PAGE
    page.write_text(REDIRECT.format(url=url), encoding="ascii")
    return webbrowser.open(page.as_uri())
