"""The page: one HTML file that needs no network, no script and no second file."""

import math
from collections.abc import Iterable, Sequence
from datetime import date
from html import escape
from pathlib import Path

from cammotion.quantities import plural
from cammotion.teaching.classroom import contest, predicted, tally
from cammotion.teaching.classroom.collect import SchoolClass, Student
from cammotion.teaching.lessons import EXERCISES, PREDICTIONS
from cammotion.teaching.messages import Outcome
from cammotion.teaching.places import FILE
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.store import right_for
from cammotion.teaching.variants import machine_for
from cammotion.views.whole_page import whole_page, wide_table

_SIGNS = {"right": "✓", "wrong": "✗", "open": "–"}
_MOST_SLIPS = 5
_MOST_STRANGERS = 20  # predictions that are not in the lessons
_STYLE = Path(__file__).with_name("page.css")


def write(school: SchoolClass, made: date) -> str:
    """Return the page of a class, as HTML; `made` is the day that stands on it."""
    begun = [lesson for lesson in _lessons() if _has_begun(lesson, school.students)]
    sections = "".join(_lesson(lesson, school.students) for lesson in begun)
    number = plural(len(school.students), "student")
    return whole_page(
        "The class at a glance",
        _STYLE,
        f"<p>{number}, {made.day} {made:%B %Y}.</p>\n"
        f"{_overview(begun, school.students)}{sections}{_others(school.students)}",
    )


def _lessons() -> list[str]:
    """Return the numbers of the lessons, in their order."""
    return sorted({key[:2] for key in (*EXERCISES, *PREDICTIONS)})


def _exercises_of(lesson: str) -> list[str]:
    return sorted(number for number in EXERCISES if number.startswith(f"{lesson}."))


def _has_begun(lesson: str, students: Iterable[Student]) -> bool:
    keys = (key for student in students for key in (*student.exercises, *student.predictions))
    return any(key.startswith(f"{lesson}.") for key in keys)


def _outcomes(student: Student, lesson: str) -> list[Outcome]:
    """Return how each exercise stands; it is right if it once was, for whatever name."""
    kept = ((number, student.exercises.get(number, {})) for number in _exercises_of(lesson))
    return [Outcome.of(number, each, is_right=bool(right_for(each))) for number, each in kept]


def _overview(lessons: Sequence[str], students: Sequence[Student]) -> str:
    """Return the table of students and lessons."""
    head = "".join(f'<th scope="col"><a href="#lesson-{n}">{n}</a></th>' for n in lessons)
    rows = "".join(
        f"<tr>{_row_head(student)}"
        + "".join(_share(_outcomes(student, lesson)) for lesson in lessons)
        + _place(student)
        + "</tr>\n"
        for student in students
    )
    places = '<th scope="col">File</th>' if any(student.place for student in students) else ""
    return wide_table(
        "Exercises that are right, by notebooks: ✓ all, ◐ some, – open",
        f'<th scope="col">Student</th>{head}{places}',
        rows,
    )


def _place(student: Student) -> str:
    place = student.place.removesuffix(f"/{FILE}")
    return f'<td class="file"><bdi>{escape(place)}</bdi></td>' if place else ""


def _share(outcomes: Sequence[Outcome]) -> str:
    states = [outcome.state for outcome in outcomes]
    if {*states} <= {"open"}:
        return f'<td class="open">{_SIGNS["open"]} open</td>'
    right = states.count("right")
    kind, sign = ("right", _SIGNS["right"]) if right == len(states) else ("begun", "◐")
    return f'<td class="{kind}">{sign} {right} of {len(states)}</td>'


def _lesson(lesson: str, students: Sequence[Student]) -> str:
    """Return the section of a lesson: predictions, exercises, slips."""
    made = [one for one in PREDICTIONS.values() if one.key.startswith(f"{lesson}.")]
    figures = "".join(predicted.show(one, students) for one in made)
    return (
        f'<section id="lesson-{lesson}" aria-labelledby="title-{lesson}">\n'
        f'<h2 id="title-{lesson}">Notebook {lesson}</h2>\n'
        + (f"<h3>What was predicted in {lesson}</h3>\n{figures}" if figures else "")
        + _exercises(lesson, students)
        + _contest(lesson, students)
        + _slips(lesson, students)
        + "</section>\n"
    )


def _exercises(lesson: str, students: Sequence[Student]) -> str:
    """Return the table of students and the exercises of a lesson."""
    numbers = _exercises_of(lesson)
    head = "".join(f'<th scope="col">{number}</th>' for number in numbers)
    rows = "".join(
        f"<tr>{_row_head(student)}{''.join(map(_state, _outcomes(student, lesson)))}</tr>\n"
        for student in students
    )
    states = [[outcome.state for outcome in _outcomes(student, lesson)] for student in students]
    right = [column.count("right") for column in zip(*states, strict=True)]
    foot = "".join(f"<td>{count} of {len(students)}</td>" for count in right)
    return f"<h3>Who has done what in {lesson}</h3>\n" + wide_table(
        f"Exercises of notebook {lesson}: ✓ right, ✗ not yet, – open",
        f'<th scope="col">Student</th>{head}',
        rows,
        f'<tr><th scope="row">right</th>{foot}</tr>',
    )


def _contest(lesson: str, students: Sequence[Student]) -> str:
    """Return the table of the best designs, if there are any."""
    rows = "".join(contest.rows(lesson, students))
    if not rows:
        return ""
    names = ("Place", "Student", "Exercise", "Times the bound", "Above it, at most")
    head = "".join(f'<th scope="col">{name}</th>' for name in names)
    caption = "The largest peak of each design by what no motions of its parts can be below"
    return f"<h3>The best design of the class</h3>\n{wide_table(caption, head, rows)}"


def _state(outcome: Outcome) -> str:
    """Return a cell: the sign, the word, and what there is to say of tries and hints."""
    word, _, rest = outcome.said.partition(", ")
    small = f"<small>{rest}</small>" if rest not in ("", "1 try") else ""
    return f'<td class="{outcome.state}">{_SIGNS[outcome.state]} {word}{small}</td>'


def _slips(lesson: str, students: Sequence[Student]) -> str:
    """Return what was answered wrong in a lesson, first what most students did."""
    parts = []
    for number in _exercises_of(lesson):
        told = tally.slips(EXERCISES[number], students)
        if not told:
            continue
        items = "".join(
            f"<li><strong>{plural(one.students, 'student')}</strong>"
            f"{f', {one.times} times' if one.times > one.students else ''}: "
            f"“{escape(one.reason)}”</li>\n"
            for one in told[:_MOST_SLIPS]
        )
        more = len(told) - _MOST_SLIPS
        rest = f"<p>And {plural(more, 'other reason')}.</p>\n" if more > 0 else ""
        question = escape(EXERCISES[number].question(machine_for()))
        parts.append(
            f"<h4>{number}</h4>\n<details><summary>The question of {number}</summary>"
            f"<p>{question}</p></details>\n<ol>\n{items}</ol>\n{rest}"
        )
    if not parts:
        return ""
    return f"<h3>What went wrong in {lesson}, and what was said</h3>\n{''.join(parts)}"


def _others(students: Sequence[Student]) -> str:
    """Return predictions that are in no lesson of this version, as of a lesson of the teacher's."""
    keys = sorted({key for s in students for key in s.predictions} - PREDICTIONS.keys())
    exercises = {number for s in students for number in s.exercises} - EXERCISES.keys()
    made = [Prediction(key, "", "", high=math.inf) for key in keys[:_MOST_STRANGERS]]
    parts = [predicted.show(one, students) for one in made]
    if len(keys) > _MOST_STRANGERS:
        parts.append(f"<p>Left out: {plural(len(keys) - _MOST_STRANGERS, 'prediction')}.</p>\n")
    if exercises:
        parts.append(
            f"<p>Left out: {plural(len(exercises), 'exercise')} that this version of the workbook "
            "does not have.</p>\n"
        )
    if not parts:
        return ""
    heading = "<h2>Of other lessons</h2>\n<h3>What this workbook does not ask</h3>\n"
    return f"<section>\n{heading}{''.join(parts)}</section>\n"


def _row_head(student: Student) -> str:
    return f'<th scope="row"><bdi>{escape(student.name)}</bdi></th>'
