"""Students of a hub who work through notebook 02, all at the same time.

Shared by the test and the benchmark.
"""

import re
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from threading import Barrier
from typing import Any

from answering import Notebook, answering, changed, numbers_of
from environments import run
from hub import Hub
from hub_environment import PAGE
from hub_student import Kernel, Student

from starter import copies

LESSON = "02"
# what is kept out of the repository of a class, until it has the solutions and then
IGNORED, IGNORED_LATER = re.findall(r"^printf .* > \.gitignore$", PAGE, re.MULTILINE)
AUTHOR = ["-c", "user.name=teacher", "-c", "user.email=teacher@localhost"]


@dataclass(frozen=True)
class Work:
    """What became of a student's lesson; `first_result_s` is counted from the click on the link."""

    student: Student
    path: str
    notebook: Notebook
    first_result_s: float
    seconds: float
    moved: int
    followed: int

    @property
    def errors(self) -> list[str]:
        """What went wrong in the cells."""
        return [
            f"{output['ename']}: {output['evalue']}"
            for cell in self.notebook["cells"]
            for output in cell.get("outputs", [])
            if output["output_type"] == "error"
        ]


def make_course(folder: Path) -> Path:
    """Make the repository of a class, as docs/classroom.md says."""
    course = folder / "cam-class"
    course.mkdir()
    copies.lay_missing(course)
    run("sh", "-c", IGNORED, at=course)
    git(course, "init", "--quiet", "--initial-branch=main")
    publish(course)
    return course


def publish(course: Path) -> None:
    """Commit what is in the repository of a class."""
    git(course, "add", ".")
    git(course, *AUTHOR, "commit", "--quiet", "--message=For the class")


def git(course: Path, *words: str) -> None:
    run("git", "-C", course, *words)


def work_at_once(hub: Hub) -> list[Work]:
    """Let all students of a hub log in, and then follow the link at the same moment."""
    students = [Student(hub, account) for account in hub.accounts]
    start = Barrier(len(students))
    with ThreadPoolExecutor(len(students)) as pool:
        return list(pool.map(lambda student: work_through(student, start), students))


def work_through(student: Student, start: Barrier) -> Work:
    """Log in, follow the link, run the lesson with right answers, move its figures, save."""
    student.log_in()
    start.wait()
    started = time.monotonic()
    path = student.pull()
    notebook = answered(student, path)
    first_result = 0.0
    moved = 0
    with student.kernel(path) as kernel:
        for cell in run_cells(kernel, notebook):
            first_result = first_result or bool(cell["outputs"]) * (time.monotonic() - started)
            kernel.move_figures()
            moved += len(kernel.figures)
        student.save(path, notebook)
    seconds = time.monotonic() - started
    return Work(student, path, notebook, first_result, seconds, moved, kernel.followed)


def answered(student: Student, path: str) -> Notebook:
    """Return the student's notebook with right answers, by the student's own numbers."""
    change = answering(student.account.name, numbers_of(LESSON))
    notebook: Notebook = changed(student.read(path), change)
    return notebook


def run_cells(kernel: Kernel, notebook: Notebook) -> Iterator[dict[str, Any]]:
    """Run the cells of a notebook, one after the other, and keep their outputs in it."""
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            cell["outputs"] = kernel.run(cell["source"])
            yield cell
