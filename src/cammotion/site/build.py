"""All files of the site, from the folder of the notebooks."""

from pathlib import Path

from cammotion.site import contents
from cammotion.site.lessons import find_lessons
from cammotion.site.pictures import IMAGES
from cammotion.site.rendering import Rendered, render, render_text
from cammotion.site.shared import shared_files

# A host that takes folders for Jekyll's leaves out names that it does not know.
_NO_JEKYLL = ".nojekyll"


def build(notebooks: Path) -> dict[str, bytes]:
    """Return the files of the site by their names; no notebook is run for it.

    Raises InputError for a folder without notebooks, and where one shows what is not there.
    """
    lessons = find_lessons(notebooks)
    drawings = notebooks / IMAGES
    first = render_text(contents.contents(lessons), contents.TITLE, contents.DESCRIPTION, drawings)
    made = {"index.html": _files("index.html", first), _NO_JEKYLL: {_NO_JEKYLL: b""}}
    for lesson in lessons:
        name = f"{lesson.name}.html"
        made[name] = _files(name, render(lesson, lessons, drawings))
    files = shared_files()
    for each in made.values():
        files |= each
    return files


def _files(name: str, page: Rendered) -> dict[str, bytes]:
    return {name: page.html.encode(), **page.pictures.shared, **page.pictures.own}
