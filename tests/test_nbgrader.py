"""A class is graded by the real nbgrader, with the commands and settings of docs/teaching.md.

nbgrader lives in an environment of its own, .venv-nbgrader. REQUIRE_NBGRADER=1 makes it.
"""

import json
import os
import re
import shlex
import shutil
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import pytest
from answering import Change, Notebook, answering, changed, numbers_of, read, then
from environments import ROOT, Environment, run

import cammotion as cm
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.variants import machine_for

PAGE = (ROOT / "docs" / "teaching.md").read_text("utf-8")
REQUIREMENT = re.findall(r"nbgrader==[\d.]+", PAGE)[0]
ENVIRONMENT = Environment(ROOT / ".venv-nbgrader")

LESSONS = {number.split(".")[0] for number in EXERCISES}
ORIGINALS = {
    path.name[:2]: path
    for path in sorted((ROOT / "notebooks").glob("*.ipynb"))
    if path.name[:2] in LESSONS
}
GRADED = "01"  # the lesson that the class hands in
ENDLESS_SECONDS = 20  # the page waits 10 s longer for a cell


@cache
def require_nbgrader() -> None:
    """Install nbgrader if it is asked for; skip where it is neither asked for nor there."""
    if os.environ.get("REQUIRE_NBGRADER") == "1":
        ENVIRONMENT.make().install("-r", "environment.txt", REQUIREMENT)
    elif not ENVIRONMENT.program("nbgrader").exists():
        pytest.skip(
            f"NOT TESTED with nbgrader: there is no {ENVIRONMENT.folder.name}. To make it: "
            "REQUIRE_NBGRADER=1 python3 workbook.py test tests/test_nbgrader.py"
        )


def block(containing: str) -> str:
    """Return the one block of Python of the teacher's page that contains a text."""
    blocks = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    (found,) = [text for text in blocks if containing in text]
    return str(found)


class Course:
    """The folder of a teacher's course."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        own = ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")
        self._environment = {name: str(folder / "own" / name) for name in own}
        # As in an activated environment: nbgrader looks for its alembic on the PATH.
        self._environment["PATH"] = f"{ENVIRONMENT.programs}{os.pathsep}{os.environ['PATH']}"
        limit, sooner = "c.Execute.timeout = 30 ", f"c.Execute.timeout = {ENDLESS_SECONDS} "
        config = block("get_config")
        assert limit in config
        (folder / "nbgrader_config.py").write_text(config.replace(limit, sooner), "utf-8")
        (folder / "marks.py").write_text(block("grades.csv"), "utf-8")
        (copying,) = re.findall(r"```sh\n(for lesson in 01.*?)```", PAGE, re.DOTALL)
        run("sh", "-ec", copying.replace("~/workbook", shlex.quote(str(ROOT))), at=folder)
        assert {path.name for path in (folder / "source").iterdir()} == ORIGINALS.keys()

    def run(self, command: str) -> str:
        """Run a command of the teacher's page, as it stands there."""
        assert re.search(rf"^{re.escape(command)}$|`{re.escape(command)}`", PAGE, re.MULTILINE)
        program, *arguments = shlex.split(command)
        return run(ENVIRONMENT.program(program), *arguments, at=self.folder, **self._environment)

    @cached_property
    def marks(self) -> dict[str, tuple[float, str]]:
        """What marks.py says of each student: the score, and whose numbers they are."""
        said = self.run("python marks.py")
        found = re.findall(rf"^{GRADED} (.+): (.+), numbers of (.*)$", said, re.MULTILINE)
        return {student: (float(score), whose) for student, score, whose in found}

    def right(self, student: str) -> list[str]:
        """Return the exercises of a graded hand-in whose checks did not end in an error."""
        cells = read(self.folder / "autograded" / student / GRADED / ORIGINALS[GRADED].name)
        return [
            cell["metadata"]["nbgrader"]["grade_id"].removeprefix("check-").replace("-", ".")
            for cell in cells["cells"]
            if "nbgrader" in cell["metadata"]
            and all(output["output_type"] != "error" for output in cell["outputs"])
        ]


def write(notebook: Notebook, path: Path) -> None:
    path.parent.mkdir(parents=True)
    path.write_text(json.dumps(notebook), "utf-8")


def only_what_counts(notebook: Notebook) -> Notebook:
    """Leave the imports and the exercises; what is between costs time and gives no points."""
    codes = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    first = next(at for at, cell in enumerate(codes) if "cm.variant(" in cell["source"])
    return {**notebook, "cells": [codes[0], *codes[first:]]}


def with_copied_check(notebook: Notebook) -> Notebook:
    """Copy the first check to the top, metadata and all, as JupyterLab does."""
    first = next(cell for cell in notebook["cells"] if "nbgrader" in cell["metadata"])
    return {**notebook, "cells": [{**first, "id": "copied"}, *notebook["cells"]]}


ALL = numbers_of(GRADED)
RIGHT_FOR_ANYBODY = [
    number
    for number in ALL
    if (exercise := EXERCISES[number])
    .judge(exercise.solution(machine_for("right")), machine_for("cheat"))
    .state
    == "right"
]
CLASS: dict[str, tuple[Change, list[str]]] = {
    "right": (answering("right", ALL), ALL),
    "half": (answering("half", ALL[::2]), ALL[::2]),
    "empty": (str, []),
    "broken": (
        then(
            answering("broken", ALL),
            {
                "answer_1 ": "answer_1 = = 55",
                "answer_2 ": "answer_2 = no_such_name",
                "answer_3 ": "import time\nwhile True:\n    time.sleep(0.1)",
            },
        ),
        ALL[3:],
    ),
    "cheat": (  # a neighbour's answers, a check that is changed and one that is deleted
        then(
            answering("cheat", ALL, whose="right"),
            {'cm.check("01.1"': "'right!'", 'cm.check("01.2"': None},
        ),
        RIGHT_FOR_ANYBODY,
    ),
}
"""What each student hands in, and what is right of it. The names are those in `cm.variant`."""


def hand_in(course: Course) -> None:
    """Let the class hand in: one a whole notebook under another name, the others by a platform."""
    original = ORIGINALS[GRADED]
    archive, platform = course.folder / "downloaded" / GRADED / "archive", course.folder / "lms"
    for student, (change, _) in CLASS.items():
        notebook = changed(read(original), change)
        if student == "right":
            target = archive / student / f"{original.stem}-Copy1.ipynb"
            write(with_copied_check(notebook), target)
        else:
            target = platform / f"{student}_17_assignsubmission_file" / original.name
            write(only_what_counts(notebook), target)
    shutil.make_archive(str(archive / "all"), "zip", platform)


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Course:
    """Grade the class, as the teacher's page says."""
    require_nbgrader()
    made = Course(tmp_path_factory.mktemp("course"))
    made.run('nbgrader generate_assignment "*"')
    hand_in(made)
    made.run("nbgrader zip_collect 01")
    made.run('nbgrader autograde "*"')
    made.run("nbgrader export")
    return made


@pytest.mark.parametrize("student", CLASS)
def test_each_student_gets_the_points_that_are_due(course: Course, student: str) -> None:
    _, due = CLASS[student]
    whose = '""' if student == "empty" else f'"{student}"'
    assert course.marks[student] == (len(due), whose)
    assert course.right(student) == due


def test_nobody_else_is_graded(course: Course) -> None:
    assert course.marks.keys() == CLASS.keys()


def test_two_notebooks_of_one_student_stop_the_collecting(tmp_path: Path) -> None:
    """As the page says, which tells what to do."""
    require_nbgrader()
    course, original = Course(tmp_path), ORIGINALS[GRADED]
    for folder in ("anna_17", "anna_18"):
        archive = tmp_path / "downloaded" / GRADED / "archive"
        write(read(original), archive / folder / original.name)
    with pytest.raises(AssertionError, match="Duplicate submission file"):
        course.run("nbgrader zip_collect 01")
    assert not (tmp_path / "submitted").exists()


def test_the_numbers_of_another_are_wrong() -> None:
    """Or the points of the cheat would prove nothing."""
    assert RIGHT_FOR_ANYBODY == ["01.4"]  # the choice


@pytest.mark.parametrize("lesson", ORIGINALS)
def test_the_release_is_the_lesson_with_its_checks_locked(course: Course, lesson: str) -> None:
    released = read(course.folder / "release" / lesson / ORIGINALS[lesson].name)["cells"]
    original = read(ORIGINALS[lesson])["cells"]
    assert [cell["source"] for cell in released] == [cell["source"] for cell in original]
    locked = [cell for cell in released if cell["metadata"].get("editable") is False]
    assert len(locked) == len(numbers_of(lesson))


@pytest.mark.parametrize("first", [0, 1])
@pytest.mark.parametrize("lesson", ORIGINALS)
def test_each_lesson_can_be_graded(
    lesson: str, first: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every second answer of each lesson, executed as nbgrader does, but without it."""
    monkeypatch.setenv("NBGRADER_EXECUTION", "autograde")
    answered = numbers_of(lesson)[first::2]
    notebook = changed(read(ORIGINALS[lesson]), answering("Anna", answered))
    names: dict[str, Any] = {}
    right, refusals = [], []
    for cell in only_what_counts(notebook)["cells"]:
        try:
            exec(cell["source"], names)  # noqa: S102 - our own
        except AssertionError as refusal:
            refusals.append(str(refusal))
        else:
            right += re.findall(r'cm\.check\("(.*?)"', cell["source"])
    cm.variant()
    assert right == answered
    assert refusals == [f"{n}: not answered yet" for n in numbers_of(lesson) if n not in answered]


def test_ci_requires_it() -> None:
    assert "REQUIRE_NBGRADER=1" in (ROOT / ".ci" / "run").read_text("utf-8")
