"""The site as it is built from the stored notebooks, once for each process of tests."""

import atexit
import shutil
import tempfile
from functools import cache
from pathlib import Path

from bs4 import BeautifulSoup

from cammotion.site import folder
from cammotion.site.build import build

ROOT = Path(__file__).parent.parent
NOTEBOOKS = ROOT / "notebooks"
LESSONS = sorted(path.stem for path in NOTEBOOKS.glob("[0-9]*.ipynb"))
PAGES = ["index", *LESSONS]


@cache
def files() -> dict[str, bytes]:
    """Return the files of the site by their names."""
    return build(NOTEBOOKS)


@cache
def page(name: str) -> BeautifulSoup:
    """Return a page, read."""
    return BeautifulSoup(files()[f"{name}.html"].decode(), "html.parser")


@cache
def written() -> Path:
    """Return the folder of the site, on a disk until the process ends."""
    home = Path(tempfile.mkdtemp(prefix="workbook-site-"))
    atexit.register(shutil.rmtree, home, ignore_errors=True)
    folder.write(home / "site", files())
    return home / "site"
