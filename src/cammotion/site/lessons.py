"""The notebooks of which pages are made, and what the contents say of each."""

import json
import re
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from nbformat import NotebookNode, ValidationError, validate
from nbformat.v4 import to_notebook

from cammotion.files import is_folder, read_text
from cammotion.quantities import InputError, shorten

_NUMBERED = "[0-9][0-9]_*.ipynb"
_TITLE = re.compile(r"^# *(?:(?P<number>\d\d) *· *)?(?P<title>.+)$", re.MULTILINE)
_QUESTION = re.compile(r"\*\*(.+?\?)\*\*", re.DOTALL)
_MINUTES = re.compile(r"about (\d+) minutes")


@dataclass(frozen=True)
class Lesson:
    """A stored notebook that becomes a page."""

    path: Path

    @cached_property
    def notebook(self) -> NotebookNode:
        """The notebook as it is stored."""
        try:
            notebook: NotebookNode = to_notebook(json.loads(read_text(self.path)))  # type: ignore[no-untyped-call]
            validate(notebook)
        except (ValueError, KeyError, AttributeError, ValidationError) as wrong:
            why = f" ({wrong.message})" if isinstance(wrong, ValidationError) else ""
            raise InputError(
                f"{self.path.name} is no notebook that can be read{why}: take it from a fresh "
                "download."
            ) from None
        return notebook

    @property
    def name(self) -> str:
        """The name of its page, without the ending."""
        return self.path.stem

    @property
    def number(self) -> str:
        """The two digits with which its name begins."""
        return self.name[:2]

    @cached_property
    def prose(self) -> list[str]:
        """What its Markdown cells say."""
        return [str(cell.source) for cell in self.notebook.cells if cell.cell_type == "markdown"]

    @property
    def title(self) -> str:
        """Its title without the number."""
        found = _TITLE.search(self.prose[0] if self.prose else "")
        return found["title"].strip() if found else self.name

    @property
    def question(self) -> str:
        """The question that it asks at its beginning, in Markdown; "" if it asks none."""
        found = _QUESTION.search(self.prose[0] if self.prose else "")
        return found[1][0].upper() + found[1][1:] if found else ""

    @property
    def minutes(self) -> str:
        """How many minutes it takes to read, "" if it does not say."""
        found = _MINUTES.search("\n".join(self.prose[:3]))
        return found[1] if found else ""


def find_lessons(folder: Path) -> list[Lesson]:
    """Return the numbered notebooks of a folder, in their order; raise InputError for none."""
    found = sorted(folder.glob(_NUMBERED)) if is_folder(folder) else []
    if not found:
        raise InputError(
            f"There are no notebooks in the folder {shorten(folder.name, of=str)}: give the one "
            "that holds 00_start_here.ipynb."
        )
    return [Lesson(path) for path in found]
