"""The best design of the class: who came nearest to the bound."""

from collections.abc import Iterable, Iterator
from html import escape

from cammotion.teaching.classroom.collect import Student
from cammotion.teaching.design_exercise import DesignExercise
from cammotion.teaching.lessons import EXERCISES

Place = tuple[float, Student]

_LEAST, _MOST = 1.0, 1000.0  # times the bound: no design is below it


def ranked(number: str, students: Iterable[Student]) -> list[Place]:
    """Return how many times the bound the students' best designs reach, the best first."""
    found = ((_best(student, number), student) for student in students)
    return sorted(((best, who) for best, who in found if best), key=lambda place: place[0])


def rows(lesson: str, students: Iterable[Student]) -> Iterator[str]:
    """Yield the rows of the contests of a lesson, as HTML."""
    for number, exercise in EXERCISES.items():
        is_contest = isinstance(exercise, DesignExercise) and exercise.is_contest
        if number.startswith(f"{lesson}.") and is_contest:
            for place, (best, student) in enumerate(ranked(number, students), 1):
                above = 100 * (best - 1)
                yield (
                    f"<tr><td>{place}</td>"
                    f'<th scope="row"><bdi>{escape(student.name)}</bdi></th>'
                    f"<td>{number}</td><td>{best:.3f}</td><td>{above:.1f} %</td></tr>\n"
                )


def _best(student: Student, number: str) -> float | None:
    """Return what a record keeps; None for nothing, and for what no design can be."""
    best = student.exercises.get(number, {}).get("best")
    return best if isinstance(best, float) and _LEAST <= best <= _MOST else None
