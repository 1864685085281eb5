"""A notebook as the lint sees it: cells, the pages they show, headings, links."""

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from html import escape
from pathlib import Path
from urllib.parse import SplitResult, unquote, urlsplit

from bs4 import BeautifulSoup, Tag
from mistune import HTMLRenderer
from nbconvert.filters.markdown_mistune import MarkdownWithMath
from nbformat import NotebookNode
from nbformat.v4 import to_notebook
from nbformat.validator import iter_validate

FENCED_OR_INLINE_CODE = re.compile(r"^(`{3,}|~{3,}).*?^\1|`[^`\n]+`", re.MULTILINE | re.DOTALL)
BINARY = {"image/png", "image/jpeg", "image/gif", "image/webp", "application/pdf"}


class _Renderer(HTMLRenderer):
    """HTML with each formula in an element of its own, so that TeX is not taken for prose."""

    def inline_math(self, body: str) -> str:
        return f"<var>${escape(body)}$</var>"

    def block_math(self, body: str) -> str:
        return f"<var>$${escape(body)}$$</var>"

    def latex_environment(self, name: str, body: str) -> str:
        return f"<var>{name} {escape(body)}</var>"


_markdown_to_html = MarkdownWithMath(_Renderer(escape=False, allow_harmful_protocols=True)).render


def _page(html: str) -> BeautifulSoup:
    return BeautifulSoup(html, "html.parser")


def split_url(url: str) -> SplitResult:
    """Split a URL; one that cannot be split gets the scheme "malformed"."""
    try:
        return urlsplit(url)
    except ValueError:
        return SplitResult("malformed", "", url, "", "")


@dataclass(frozen=True)
class Cell:
    """One cell; as text, the name by which a fault calls it."""

    number: int
    node: NotebookNode

    def __str__(self) -> str:
        """Name the cell as a fault does."""
        return f"cell {self.number} (id {self.node.id})"

    @property
    def source(self) -> str:
        """The source of any cell."""
        return str(self.node.source)

    @property
    def code(self) -> str:
        """The source of a code cell, else nothing."""
        return self.source if self.node.cell_type == "code" else ""

    @property
    def prose(self) -> str:
        """The source of a Markdown cell, else nothing."""
        return self.source if self.node.cell_type == "markdown" else ""

    @property
    def paragraphs(self) -> list[str]:
        """The Markdown source, its code left out, split at blank lines."""
        prose = FENCED_OR_INLINE_CODE.sub("code", self.prose)
        return [text.strip() for text in re.split(r"\n\s*\n", prose)]

    @property
    def outputs(self) -> list[NotebookNode]:
        """The outputs of a code cell, else none."""
        return list(self.node.get("outputs", ()))

    @property
    def bundles(self) -> list[NotebookNode]:
        """The MIME bundles among the outputs."""
        return [output.data for output in self.outputs if "data" in output]

    @property
    def output_texts(self) -> Iterator[str]:
        """All that the outputs store as text."""
        for output in self.outputs:
            yield str(output.get("text", ""))
            yield "\n".join(output.get("traceback", ()))
        for bundle in self.bundles:
            yield from (str(value) for kind, value in bundle.items() if kind not in BINARY)

    @cached_property
    def prose_page(self) -> BeautifulSoup:
        """The Markdown source as HTML."""
        return _page(_markdown_to_html(self.prose))

    @cached_property
    def pages(self) -> list[BeautifulSoup]:
        """All that a reader sees as hypertext, be it source or output."""
        html = [bundle.get("text/html", "") for bundle in self.bundles]
        markdown = [_markdown_to_html(bundle.get("text/markdown", "")) for bundle in self.bundles]
        return [self.prose_page, *map(_page, filter(None, html + markdown))]

    def select(self, selector: str) -> list[Tag]:
        """Return the elements of the pages that match a CSS selector."""
        return [tag for page in self.pages for tag in page.select(selector)]

    @property
    def urls(self) -> list[SplitResult]:
        """Where links and pictures point."""
        tags = self.select("a[href], [src]")
        return [split_url(str(tag.get("href", tag.get("src")))) for tag in tags]

    @property
    def word_count(self) -> int:
        """The number of words of prose, without code and formulas."""
        texts = self.prose_page.find_all(string=True)
        prose = " ".join(text for text in texts if not text.find_parent(["pre", "var"]))
        return len(re.findall(r"[^\W\d_][\w'-]*", prose))


@dataclass(frozen=True)
class Heading:
    """A heading and where it stands."""

    cell: Cell
    level: int
    text: str

    @property
    def anchor(self) -> str:
        """The name that JupyterLab gives it, to link to."""
        return self.text.replace(" ", "-")


@dataclass(frozen=True)
class Notebook:
    """A notebook of valid format and the file it came from."""

    path: Path
    node: NotebookNode

    @cached_property
    def cells(self) -> list[Cell]:
        """All cells, numbered from 1."""
        return [Cell(number, node) for number, node in enumerate(self.node.cells, 1)]

    @cached_property
    def headings(self) -> list[Heading]:
        """All headings of the Markdown cells."""
        return [
            Heading(cell, int(tag.name[1]), tag.get_text())
            for cell in self.cells
            for tag in cell.prose_page.select("h1, h2, h3, h4, h5, h6")
        ]

    @property
    def urls(self) -> list[tuple[Cell, SplitResult]]:
        """Where links and pictures point, and from which cell."""
        return [(cell, url) for cell in self.cells for url in cell.urls]

    @property
    def is_lesson(self) -> bool:
        """Whether it is one of the numbered notebooks from 01 on, not their solutions."""
        is_numbered = re.match(r"(?!00)\d\d_", self.path.name) is not None
        return is_numbered and self.path.parent.name != "solutions"

    @property
    def top(self) -> Path:
        """The folder that holds `notebooks/`."""
        homes = (folder for folder in self.path.parents if folder.name == "notebooks")
        return next(homes, self.path.parent).parent

    def file(self, url: SplitResult) -> Path | None:
        """Return the file that a relative link means, None for any other link."""
        if url.scheme or url.netloc or url.path[:1] in {"", "/"}:
            return None
        return (self.path.parent / unquote(url.path)).resolve()


def format_faults(path: Path) -> Iterator[str]:
    """Say why a file is not a notebook of format 4.5; all else here relies on that format."""
    try:
        raw = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as problem:
        yield f"notebook: not JSON in UTF-8: {problem}"
        return
    errors = iter_validate(raw or {}, version=4, version_minor=5)  # type: ignore[no-untyped-call]
    for error in errors:
        place = "/".join(map(str, error.absolute_path))
        yield f"notebook: '{place}' is not of format 4.5: {error.message[:200]}"


def read(path: Path) -> Notebook:
    """Read a notebook of valid format."""
    raw = json.loads(path.read_text(encoding="utf-8"))
    return Notebook(path.resolve(), to_notebook(raw))  # type: ignore[no-untyped-call]
