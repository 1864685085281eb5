"""The site as it is built from the stored notebooks, once for a run of tests."""

import base64
import gzip
from functools import cache
from pathlib import Path

from bs4 import BeautifulSoup
from once import made_once

from cammotion.site import folder
from cammotion.site.build import build

ROOT = Path(__file__).parent.parent
NOTEBOOKS = ROOT / "notebooks"
LESSONS = sorted(path.stem for path in NOTEBOOKS.glob("[0-9]*.ipynb"))
PAGES = ["index", *LESSONS]


@cache
def written() -> Path:
    """Return the folder of the site, on a disk until the run ends."""
    return made_once("site", lambda place: folder.write(place, build(NOTEBOOKS)))


@cache
def files() -> dict[str, bytes]:
    """Return the files of the site by their names."""
    found = (path for path in written().rglob("*") if path.is_file())
    named = {path.relative_to(written()).as_posix(): path.read_bytes() for path in found}
    del named[folder.MARKER]
    return named


@cache
def page(name: str) -> BeautifulSoup:
    """Return a page, read."""
    return BeautifulSoup(files()[f"{name}.html"].decode(), "html.parser")


def unpack(packed: str) -> str:
    """Return what `pack` has packed, as the script of a page does."""
    return gzip.decompress(base64.b64decode(packed)).decode()
