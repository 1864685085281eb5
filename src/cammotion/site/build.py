"""All files of the site, from the folder of the notebooks."""

import re
from pathlib import Path

from cammotion.quantities import InputError, shorten
from cammotion.site import contents
from cammotion.site.lessons import find_lessons
from cammotion.site.pictures import IMAGES
from cammotion.site.rendering import Rendered, render, render_text
from cammotion.site.shared import shared_files

# A host that takes folders for Jekyll's leaves out names that it does not know.
_NO_JEKYLL = ".nojekyll"
_ADDRESS = re.compile(r"https?://[^\s/]+\S*")


def build(notebooks: Path, home: str = "") -> dict[str, bytes]:
    """Return the files of the site by their names; no notebook is run for it.

    `home` is the address of the workbook, to which the pages then link. Raises InputError for a
    folder without notebooks, where one shows what is not there, and for what is no address.
    """
    if home and not _ADDRESS.fullmatch(home):
        raise InputError(
            f"{shorten(home)} is no address of a web page: give one that begins with https://."
        )
    lessons = find_lessons(notebooks)
    drawings = notebooks / IMAGES
    first = render_text(
        contents.contents(lessons), contents.TITLE, contents.DESCRIPTION, drawings, home
    )
    made = {"index.html": _files("index.html", first), _NO_JEKYLL: {_NO_JEKYLL: b""}}
    for lesson in lessons:
        name = f"{lesson.name}.html"
        made[name] = _files(name, render(lesson, lessons, drawings, home))
    files = shared_files()
    for each in made.values():
        files |= each
    return files


def _files(name: str, page: Rendered) -> dict[str, bytes]:
    return {name: page.html.encode(), **page.pictures.shared, **page.pictures.own}
