"""A stored notebook becomes a page of HTML, by nbconvert and a template of our own."""

import base64
from collections.abc import Collection
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bs4 import BeautifulSoup
from jinja2 import pass_context
from nbconvert import HTMLExporter
from nbformat.v4 import new_markdown_cell, new_notebook
from traitlets.config import Config

from cammotion.site.answers import packed_answers
from cammotion.site.cells import Arranged, Arranger
from cammotion.site.figures import animation, live_figure
from cammotion.site.formulas import shown_formula
from cammotion.site.lessons import Lesson
from cammotion.site.pictures import Pictures, embedded_svg
from cammotion.site.prose import Prose
from cammotion.teaching.variants import NAMELESS
from cammotion.views.live.figure import MIME

_TEMPLATES = Path(__file__).parent / "templates"
_PYTHON = {"language_info": {"name": "python", "pygments_lexer": "python"}}
_LONG = 12  # lines: code that is longer is folded
_ROOM = 81  # letters: so many has a printed line beside which nothing is hidden on a laptop
_ORDER = [MIME, "text/html", "text/markdown", "text/latex", "image/png", "text/plain"]


@dataclass(frozen=True)
class Rendered:
    """A page and the pictures that it shows."""

    html: str
    pictures: Pictures


def render(lesson: Lesson, lessons: Collection[Lesson], drawings: Path, home: str = "") -> Rendered:
    """Return the page of a notebook; `lessons` are all of them, `drawings` their pictures.

    `home` is the address of the workbook, if it has one.
    """
    order = [*lessons]
    place = order.index(lesson)
    page = {
        "title": lesson.title,
        "number": lesson.number,
        "description": lesson.question.replace("*", ""),
        "before": order[place - 1] if place else None,
        "after": order[place + 1] if place + 1 < len(order) else None,
        "home": home,
    }
    pictures = Pictures(lesson.number, drawings)
    prose = Prose({one.name for one in lessons}, pictures)
    arranged = Arranger(prose.html).arrange(deepcopy(lesson.notebook.cells))
    return Rendered(_exported(arranged, prose, pictures, page), pictures)


def render_text(
    markdown: str, title: str, description: str, drawings: Path, home: str = ""
) -> Rendered:
    """Return a page of Markdown alone, such as the contents."""
    pictures = Pictures("contents", drawings)
    cell = new_markdown_cell(markdown, id="contents")  # type: ignore[no-untyped-call]
    page = {"title": title, "description": description, "is_contents": True, "home": home}
    prose = Prose((), pictures)
    return Rendered(_exported(Arranged([cell]), prose, pictures, page), pictures)


def _exported(arranged: Arranged, prose: Prose, pictures: Pictures, page: dict[str, Any]) -> str:
    packed = packed_answers(arranged.exercises, arranged.predictions, NAMELESS)
    exporter = _Exporter(prose, pictures)
    notebook = new_notebook(cells=arranged.cells, metadata=_PYTHON)  # type: ignore[no-untyped-call]
    resources = {"page": page | {"answers": packed}}
    html, _ = exporter.from_notebook_node(notebook, resources)
    return _finished(html)


class _Exporter(HTMLExporter):
    """nbconvert's exporter with our template, and filters for what a page shows otherwise."""

    def __init__(self, prose: Prose, pictures: Pictures) -> None:
        self._prose, self._pictures = prose, pictures
        super().__init__(  # type: ignore[no-untyped-call]
            template_name="page",
            extra_template_basedirs=[str(_TEMPLATES)],
            config=Config({"NbConvertBase": {"display_data_priority": _ORDER}}),
            filters={
                "is_long": lambda source: source.count("\n") >= _LONG,
                "is_setup": lambda source: source.startswith(("import ", "from ")),
                "lines": lambda source: source.count("\n") + 1,
                "kind": _kind_of_print,
                "formula": shown_formula,
                "html_output": self._html_output,
                "figure": self._figure,
                "picture": self._picture,
            },
        )

    @pass_context
    def markdown2html(self, context: Any, source: str) -> str:  # noqa: ARG002 - nbconvert's
        """Return Markdown as this page shows it."""
        return self._prose.html(source)

    def _html_output(self, output: Any) -> str:
        html = str(output.data["text/html"])
        svg = embedded_svg(html)
        return animation(svg) if svg else html

    def _figure(self, output: Any, name: str) -> str:
        return live_figure(str(output.data[MIME]), self._picture(output, name))

    def _picture(self, output: Any, name: str) -> str:
        words = output.metadata.get("image/png", {}).get("alt") or output.data["text/plain"]
        png = base64.b64decode(output.data["image/png"])
        return self._pictures.png(name, png, str(words))


def _kind_of_print(text: str) -> str:
    """Return the class of what is printed: sentences are wrapped, what is laid out stays so."""
    is_long = any(len(line) > _ROOM for line in text.splitlines())
    return "printed sentences" if is_long and "  " not in text else "printed"


def _finished(html: str) -> str:
    """Return the page with a list of its sections, and tables that can be scrolled."""
    page = BeautifulSoup(html, "html.parser")
    places = page.select_one("nav.sections ul")
    if places is not None:
        for heading in page.select("main h2[id]"):
            link = page.new_tag("a", href=f"#{heading['id']}")
            link.append(heading.get_text())
            item = page.new_tag("li")
            item.append(link)
            places.append(item)
    for table in page.select("main table"):
        table.wrap(page.new_tag("div", attrs={"class": "table"}))
    return str(page)
