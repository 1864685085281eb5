"""What becomes of each cell on a page: prose, code with what it showed, or something to fill in."""

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from nbformat import NotebookNode
from nbformat.v4 import new_output

from cammotion.quantities import InputError, plural
from cammotion.site import forms
from cammotion.site.wording import as_on_a_page
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import Exercise
from cammotion.teaching.lessons import PREDICTIONS, find_exercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.variants import NAMELESS

LAB_ONLY = "lab-only"  # the tag of a cell that makes no sense without a kernel
_QUESTION = re.compile(r'^cm\.(?:ask|choose)\("([^"]+)"\)$')
_ANSWER = re.compile(r"^answer_\d+ = None|^cm\.check\(")
_VARIANT = re.compile(r"\bcm\.variant\(")
_MACHINE = re.compile(r"\b(?:mill|die)\b")  # what is asked about, where it is the machine


@dataclass(frozen=True)
class Arranged:
    """The cells of a page, and what is asked in them."""

    cells: list[NotebookNode] = field(default_factory=list)
    exercises: list[Exercise] = field(default_factory=list)
    predictions: list[Prediction] = field(default_factory=list)


class Arranger:
    """Goes through the cells of a notebook and makes those of a page."""

    def __init__(self, render: forms.Render, machine: MillAndDie = NAMELESS) -> None:
        self._render, self._machine = render, machine
        self._keys: dict[str, str] = {}  # of predictions, by the variables that hold them
        self._made = Arranged()

    def arrange(self, cells: list[NotebookNode]) -> Arranged:
        """Return the cells of the page."""
        for cell in cells:
            if LAB_ONLY not in cell.metadata.get("tags", ()):
                self._made.cells.extend(self._of(cell))
        if not any(_MACHINE.search(one.question(self._machine)) for one in self._made.exercises):
            self._made.cells[:] = [cell for cell in self._made.cells if not _tells_machine(cell)]
        return self._made

    def _of(self, cell: NotebookNode) -> Iterator[NotebookNode]:
        if cell.cell_type == "markdown":
            cell.source = as_on_a_page(cell.source)
        elif cell.cell_type == "code":
            if _ANSWER.search(cell.source):
                return
            self._see(cell)
        yield cell

    def _see(self, cell: NotebookNode) -> None:
        """Put into a code cell what it shows on a page."""
        source = cell.source.strip()
        if asked := _QUESTION.match(source):
            exercise = find_exercise(asked[1])
            self._made.exercises.append(exercise)
            _show(cell, forms.exercise_form(exercise, self._machine, self._render), alone=True)
        elif called := _call(source, "predict"):
            variable, texts = called
            if len(texts) != 2:  # noqa: PLR2004 - key and what is asked
                raise InputError(
                    f"The cell {cell.id} asks for a prediction, but not by two plain texts: write "
                    'guess = cm.predict("01.half", "degrees for each way").'
                )
            key, words = texts
            self._keys[variable] = key
            made = PREDICTIONS.get(key)
            self._made.predictions.extend([made] if made else [])
            is_number = made is not None and not isinstance(made.true, str)
            _show(cell, forms.prediction_form(key, words, is_number=is_number), alone=True)
        elif called := _call(source, "reveal"):
            self._reveal(cell, called[0])
        elif _tells_machine(cell):
            cell.metadata["alone"] = True

    def _reveal(self, cell: NotebookNode, variable: str) -> None:
        if variable not in self._keys:
            raise InputError(f"The cell {cell.id} reveals {variable}, which no cell has asked for.")
        stored = [o.data["text/html"] for o in cell.outputs if "text/html" in o.get("data", {})]
        if len(stored) != 1:
            raise InputError(
                f"The cell {cell.id} reveals {variable} and has {plural(len(stored), 'output')} in "
                "HTML, where the answer is the only one: show nothing else there, and run the "
                "notebook with `python3 workbook.py refresh`."
            )
        others = [o for o in cell.outputs if "text/html" not in o.get("data", {})]
        _show(cell, forms.reveal(stored[0], self._keys[variable]))
        cell.outputs = [*others, *cell.outputs]


def _tells_machine(cell: NotebookNode) -> bool:
    return cell.cell_type == "code" and bool(_VARIANT.search(cell.source))


def _show(cell: NotebookNode, html: str, *, alone: bool = False) -> None:
    """Let a cell show this; `alone` without its code."""
    cell.outputs = [new_output("display_data", {"text/html": html})]  # type: ignore[no-untyped-call]
    cell.metadata["alone"] = alone


def _call(source: str, method: str) -> tuple[str, list[str]] | None:
    """Return who makes or has a method's call on the top level of a cell, and its plain texts."""
    try:
        lines = ast.parse(source).body
    except SyntaxError:  # a command of IPython, or a mistake on purpose
        return None
    for line in lines:
        call = getattr(line, "value", None)
        if not isinstance(call, ast.Call) or not isinstance(call.func, ast.Attribute):
            continue
        if call.func.attr == method:
            whose = line.targets[0] if isinstance(line, ast.Assign) else call.func.value
            texts = [word.value for word in call.args if isinstance(word, ast.Constant)]
            return ast.unparse(whose), [str(text) for text in texts]
    return None
