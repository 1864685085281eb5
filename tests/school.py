"""A folder as a teacher collects it, with files of known content, and how the page is read."""

import json
import shutil
from datetime import date
from pathlib import Path

from bs4 import BeautifulSoup, Tag

from cammotion.teaching.classroom import page
from cammotion.teaching.classroom.collect import SchoolClass

DATA = Path(__file__).parent / "data" / "class"
KNOWN = {
    "Room 1/Anna/progress.json": "anna",
    "work-ben/progress.json": "ben",
    "carla.JSON": "carla-of-an-older-version",
}
"""Where the known files lie in the folder of a teacher."""
HOSTILE = "<script>alert('&')</script>\u202e\x07\ud800\"><img src=x onerror=alert(1)>"


def collect(folder: Path) -> Path:
    """Collect the known files in a folder, and return it."""
    for place, name in KNOWN.items():
        file = folder / place
        file.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(DATA / f"{name}.json", file)
    return folder


def find(soup: Tag, selector: str) -> Tag:
    """Return the first element that a selector finds."""
    found = soup.select_one(selector)
    assert found is not None
    return found


def show(school: SchoolClass) -> BeautifulSoup:
    return BeautifulSoup(page.write(school, date(2026, 3, 2)), "html.parser")


def text_of(tag: Tag | None) -> str:
    assert tag is not None
    return " ".join(tag.get_text(" ").split())


def table_of(soup: BeautifulSoup, caption: str) -> list[list[str]]:
    """Return the cells of the table whose caption begins so."""
    (table,) = (t for t in soup("table") if text_of(t.caption).startswith(caption))
    return [[text_of(cell) for cell in row(["th", "td"])] for row in table("tr")]


def put(folder: Path, place: str, content: object) -> Path:
    file = folder / place
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(content), encoding="utf-8")
    return file
