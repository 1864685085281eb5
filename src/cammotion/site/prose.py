"""Markdown as a page shows it: formulas as MathML, pictures as files, links from page to page."""

import re
from collections.abc import Collection
from html import escape, unescape
from pathlib import PurePosixPath
from typing import Any
from urllib.parse import unquote, urlsplit

from nbconvert.filters.markdown_mistune import IPythonRenderer, MarkdownWithMath

from cammotion.site.formulas import mathml
from cammotion.site.pictures import Pictures

_TAG = re.compile(r"<[^>]+>")
_AROUND = re.compile(r"(\(?<math>(?:(?!</math>).)*</math>[),.;:!?]+)", re.DOTALL)
_TOGETHER = r'<span class="together">\1</span>'  # a line does not begin with a comma
NOTEBOOK, PAGE = ".ipynb", ".html"


class Prose(IPythonRenderer):
    """Renders the Markdown of one notebook."""

    def __init__(self, pages: Collection[str], pictures: Pictures) -> None:
        super().__init__(escape=False, exclude_anchor_links=True)
        self._pages, self._pictures = pages, pictures

    def html(self, markdown: str) -> str:
        """Return Markdown as HTML."""
        return _AROUND.sub(_TOGETHER, str(MarkdownWithMath(renderer=self).render(markdown)))

    def inline_math(self, body: str) -> str:
        """Return a formula in its line."""
        return mathml(body)

    def block_math(self, body: str) -> str:
        """Return a formula that stands alone."""
        return mathml(body, block=True)

    def latex_environment(self, name: str, body: str) -> str:
        """Return an environment, which stands alone too."""
        return mathml(rf"\begin{{{name}}}{body}\end{{{name}}}", block=True)

    def heading(self, text: str, level: int, **attrs: Any) -> str:  # noqa: ARG002 - mistune's
        """Return a heading that can be linked to by the name that JupyterLab gives it."""
        name = _TAG.sub("", text).replace(" ", "-")
        return f'<h{level} id="{escape(name)}">{text}</h{level}>\n'

    def link(self, text: str, url: str, title: str | None = None) -> str:
        """Return a link to another page; of one that leads nowhere here only its words."""
        target = self._target(url)
        return str(super().link(text, target, title)) if target else text

    def image(self, text: str, url: str, title: str | None = None) -> str:  # noqa: ARG002
        """Return a drawing of the workbook with its words."""
        words = unescape(_TAG.sub("", text))
        is_first = not self._pictures.shared
        return self._pictures.drawing(PurePosixPath(url).name, words, is_first=is_first)

    def _target(self, url: str) -> str:
        parts = urlsplit(url)
        path = PurePosixPath(unquote(parts.path))
        if parts.scheme or not parts.path:
            return url
        if path.suffix == NOTEBOOK and path.stem in self._pages and path.parent.name != "solutions":
            return parts._replace(path=f"{path.stem}{PAGE}").geturl()
        return ""
