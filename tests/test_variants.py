"""A machine for each learner: always solvable, always in range, the same for the same name."""

import hashlib
import math
import os
import re
import runpy
import subprocess
import sys
import unicodedata
from dataclasses import asdict, replace
from itertools import product
from pathlib import Path
from typing import Any

import known_slips_10
import numpy as np
import pytest
import sympy
from judging import is_right
from known_slips import die, law, place, rest, stroke, widest

import cammotion as cm
from cammotion.limits.widest import with_angle
from cammotion.quantities import Floats
from cammotion.rules.checks import find_violations
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.fit_numbers import FIT_CHOICES, FitNumbers
from cammotion.teaching.follower_numbers import FOLLOWER_CHOICES
from cammotion.teaching.law_numbers import LawNumbers
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.table_numbers import TABLE_CHOICES
from cammotion.teaching.variants import LAW_CHOICES, NAMELESS, machine_for

RANGES = {
    "rate_per_hour": (1200, 3000),
    "pitch_mm": (80, 130),
    "stops": (16, 32),
    "mill_angle_deg": (120, 170),
    "work_deg": (70, 120),
    "wait_mm": (15, 30),
    "pocket_mm": (20, 40),
    "gap_mm": (1, 1),
    "margin_mm": (1, 3),
    "die_mass_kg": (5, 30),
}
CHEAP = ("01.1", "01.2", "01.3", "02.3", "02.4", "03.2", "04.2")
NEVER_CHANGED: dict[str | int, tuple[float, ...]] = {
    "Anna": (2700, 120, 16, 150, 110, 27, 36, 1, 2, 29),
    7: (2400, 110, 16, 170, 80, 22, 25, 1, 1.5, 19),
    "Jörg Müller": (1600, 90, 16, 160, 120, 19, 39, 1, 1, 27),
}
"""What a name has led to since the first day; a notebook of last year has to stay right.

The slots of the wheel are other ones since 08.4 could be right by chance with 4, 6, 9 or 10. So are
the heads of 10.4, since with 2 or 5 kg a wrong way could lead to the right number.
"""
LAWS_NEVER_CHANGED: dict[str | int, LawNumbers] = {
    "Anna": LawNumbers(
        powers=(2, 4),
        compared=("3-4-5 polynomial", "cycloidal"),
        fastest=1.6,
        head_start=0.45,
        pause=0.25,
    ),
    7: LawNumbers(
        powers=(2, 4),
        compared=("modified trapezoid", "3-4-5 polynomial"),
        fastest=1.6,
        head_start=0.65,
        pause=0.5,
    ),
    "Jörg Müller": LawNumbers(
        powers=(3, 5),
        compared=("Freudenstein 1-3-5", "cycloidal"),
        fastest=1.75,
        head_start=0.35,
        pause=0.2,
    ),
}
TABLES_NEVER_CHANGED: dict[str | int, tuple[Any, ...]] = {
    "Anna": (54, 560, 200, 5, 6, 70, 0.65, 55, "cycloidal", 120, 14, 45),
    7: (72, 560, 200, 5, 7, 110, 0.7, 55, "cycloidal", 90, 7, 28),
    "Jörg Müller": (48, 560, 220, 9, 4, 80, 0.55, 45, "3-4-5 polynomial", 90, 11, 24),
}

FITS_NEVER_CHANGED: dict[str | int, FitNumbers] = {
    "Anna": FitNumbers(
        shaft=(32, 10), lag_deg=0.02, bore_mm=16, pair=("H7", "d6"), turned_mm=15, grade=10
    ),
    7: FitNumbers(
        shaft=(28, 8), lag_deg=0.05, bore_mm=60, pair=("H8", "d7"), turned_mm=12, grade=7
    ),
    "Jörg Müller": FitNumbers(
        shaft=(55, 16), lag_deg=0.08, bore_mm=90, pair=("H7", "d6"), turned_mm=110, grade=7
    ),
}

FOLLOWERS_NEVER_CHANGED: dict[str | int, tuple[Any, ...]] = {
    "Anna": (
        (13, 85, 1400, 7, 78),
        36,
        (0.22, 12),
        8,
        130,
        12,
        3,
        0.9,
        8,
        11,
        320,
        140,
        16,
        1.75,
        0.3,
    ),
    7: ((6, 105, 2800, 6, 76), 42, (0.14, 10), 9, 130, 6, 2, 3.1, 4, 11, 450, 210, 16, 2.75, 0.3),
    "Jörg Müller": (
        (16, 100, 2700, 5, 190),
        18,
        (0.22, 12),
        16,
        130,
        8,
        1.5,
        1.5,
        6,
        10,
        450,
        260,
        28,
        3,
        0.2,
    ),
}


@pytest.fixture(scope="module")
def machines() -> list[MillAndDie]:
    """Return 2,000 machines, of names and of numbers."""
    return [machine_for(who) for n in range(1000) for who in (n, f"Learner {n}")]


@pytest.fixture(scope="module")
def sample(machines: list[MillAndDie]) -> list[MillAndDie]:
    return [NAMELESS, *machines[::10]]


def column(machines: list[MillAndDie], name: str) -> Floats:
    """Return a property of all machines."""
    return np.array([getattr(machine, name) for machine in machines], dtype=float)


def numbers_of(machine: MillAndDie) -> tuple[float, ...]:
    return tuple(getattr(machine, name) for name in RANGES)


def test_every_number_is_in_its_range(machines: list[MillAndDie]) -> None:
    for name, (low, high) in RANGES.items():
        values = column(machines, name)
        assert low <= values.min()
        assert values.max() <= high
        assert {low, high} <= {*values}, name


def test_every_law_is_drawn_and_never_the_sources(machines: list[MillAndDie]) -> None:
    for name, choices in LAW_CHOICES.items():
        assert {getattr(machine.laws, name) for machine in machines} == {*choices}
        assert getattr(EXAMPLE.laws, name) not in choices
        assert getattr(NAMELESS.laws, name) in choices


def test_every_number_of_a_table_is_drawn_and_never_the_sources(
    machines: list[MillAndDie],
) -> None:
    for name, choices in TABLE_CHOICES.items():
        assert {getattr(machine.table, name) for machine in machines} == {*choices}
        assert getattr(EXAMPLE.table, name) not in choices
        assert getattr(NAMELESS.table, name) in choices
    assert all(m.table.hole_mm < m.table.radius_mm < m.table.plate_mm for m in machines)


def test_every_fit_is_drawn_and_never_the_lessons(machines: list[MillAndDie]) -> None:
    for name, choices in FIT_CHOICES.items():
        assert {getattr(machine.fits, name) for machine in machines} == {*choices}
        assert getattr(EXAMPLE.fits, name) not in choices
        assert getattr(NAMELESS.fits, name) in choices


def test_every_number_of_a_follower_is_drawn_and_never_the_lessons(
    machines: list[MillAndDie],
) -> None:
    for name, choices in FOLLOWER_CHOICES.items():
        assert {getattr(machine.follower, name) for machine in machines} == {*choices}
        assert getattr(EXAMPLE.follower, name) not in choices
    assert all(len({*spared}) == len(spared) for spared in FOLLOWER_CHOICES.values())


def test_no_wrong_way_of_10_4_leads_to_the_right_number_with_any_choice() -> None:
    """With 2 or 5 kg it could: the squares of two periods, or two masses taken as equal."""
    wrong = [slip for slip in known_slips_10.SLIPS if slip.number == "10.4"]
    names = ("m1_kg", "m2_kg", "k1_N_per_mm", "k2_N_per_mm")
    for values in product(*(FOLLOWER_CHOICES[name] for name in names)):
        follower = replace(NAMELESS.follower, **dict(zip(names, values, strict=True)))
        machine = replace(NAMELESS, follower=follower)
        right = known_slips_10.lower(machine)
        for slip in wrong:
            beside = math.isclose(slip.answer(machine), right, rel_tol=0.002)
            assert not beside, (slip.name, values)


def test_the_die_always_has_room(machines: list[MillAndDie]) -> None:
    angles = column(machines, "die_angle_deg")
    assert angles.min() >= 40
    left = 360 - column(machines, "mill_angle_deg") - column(machines, "work_deg")
    assert np.array_equal(angles, left / 2)
    assert (column(machines, "margin_mm") < column(machines, "wait_mm")).all()


def test_the_widest_move_always_leaves_a_rest_at_the_top(machines: list[MillAndDie]) -> None:
    share = column(machines, "limit_mm") / column(machines, "stroke_mm")
    low, high = np.zeros_like(share), np.ones_like(share)
    for _ in range(50):  # the cycloid's inverse, by halving
        middle = (low + high) / 2
        below = middle - np.sin(2 * np.pi * middle) / (2 * np.pi) < share
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    widest_deg = column(machines, "overlapped_deg") / (1 - low)
    assert (widest_deg > column(machines, "die_angle_deg")).all()
    assert (360 - column(machines, "work_deg") - 2 * widest_deg).min() >= 4 - 1e-9


def test_hardly_any_two_are_alike(machines: list[MillAndDie]) -> None:
    assert len({*machines}) >= 1998
    assert EXAMPLE not in machines


def test_the_widest_move_keeps_its_rule_and_a_wider_one_breaks_it(sample: list[MillAndDie]) -> None:
    for machine in sample:
        angle = machine.widest_deg
        assert angle == pytest.approx(widest(machine), abs=1e-6)
        assert 2 * angle + machine.work_deg <= 360 - 4 + 1e-9
        for wider, breaks in ((0.0, False), (0.01, True)):
            moved = with_angle(machine.die, angle + wider)
            diagram = cm.TimingDiagram((machine.mill, moved), machine.rate_per_hour)
            assert bool(find_violations(diagram, [machine.rule])) is breaks, (machine.who, wider)


def test_every_answer_is_finite_and_positive(machines: list[MillAndDie]) -> None:
    for number in CHEAP:
        answers = np.array([EXERCISES[number].solution(machine) for machine in machines])
        assert np.isfinite(answers).all(), number
        assert answers.min() > 0, number


def test_every_exercise_is_solvable_with_a_sample(sample: list[MillAndDie]) -> None:
    for exercise in EXERCISES.values():
        if isinstance(exercise, NumberExercise):
            answers = np.array([exercise.solution(machine) for machine in sample])
            assert np.isfinite(answers).all(), exercise.number
            assert answers.min() > 0, exercise.number


def test_the_numbers_agree_with_those_done_by_hand(sample: list[MillAndDie]) -> None:
    for machine in sample:
        assert machine.stroke_mm == stroke(machine)
        assert machine.die_angle_deg == die(machine)
        assert machine.limit_mm == machine.wait_mm - machine.margin_mm
        x = place(machine.limit_mm / machine.stroke_mm)
        assert law(x) == pytest.approx(machine.limit_mm / machine.stroke_mm)
        assert rest(machine) > 0


@pytest.mark.parametrize("who", [*NEVER_CHANGED], ids=str)
def test_a_name_leads_to_the_same_numbers_for_ever(who: str | int) -> None:
    assert numbers_of(machine_for(who)) == NEVER_CHANGED[who]
    assert machine_for(who).laws == LAWS_NEVER_CHANGED[who]
    assert (*asdict(machine_for(who).table).values(),) == TABLES_NEVER_CHANGED[who]
    assert machine_for(who).fits == FITS_NEVER_CHANGED[who]
    assert (*asdict(machine_for(who).follower).values(),) == FOLLOWERS_NEVER_CHANGED[who]


def test_no_number_of_two_thousand_learners_has_changed(machines: list[MillAndDie]) -> None:
    """Where this is meant, CHANGELOG says so, and whose answers it makes wrong."""
    every = "\n".join(repr(asdict(machine)) for machine in (NAMELESS, *machines))
    assert hashlib.sha256(every.encode()).hexdigest()[:16] == "ce8d2c9d3b525c0a"


def test_the_numbers_do_not_depend_on_the_hash_of_a_run() -> None:
    code = (
        "from cammotion.teaching.variants import machine_for\n"
        f"for who in {[*NEVER_CHANGED]!r}:\n"
        f"    print([getattr(machine_for(who), name) for name in {[*RANGES]!r}])"
    )
    run = subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | {"PYTHONHASHSEED": "1", "PYTHONUTF8": "1"},
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=True,
    )
    assert run.stdout.splitlines() == [str([*numbers]) for numbers in NEVER_CHANGED.values()]


@pytest.mark.parametrize(
    "spelling",
    [
        "jörg müller",
        "JÖRG MÜLLER",
        "  Jörg Müller\n",
        unicodedata.normalize("NFD", "Jörg Müller"),
        "\uff2aörg Müller",  # with a full-width J
    ],
)
def test_spellings_of_a_name(spelling: str) -> None:
    assert machine_for(spelling) == machine_for("Jörg Müller")


@pytest.mark.parametrize("seven", ["7", " 7 ", "\uff17", np.int64(7), sympy.Integer(7)])
def test_spellings_of_a_number(seven: Any) -> None:
    assert machine_for(seven) == machine_for(7)


@pytest.mark.parametrize("nobody", ["", "   ", "\n\t", "\u3000"])
def test_without_a_name_the_numbers_are_the_same_for_all_and_not_the_sources(nobody: str) -> None:
    assert machine_for(nobody) == NAMELESS == machine_for() != EXAMPLE
    assert NAMELESS.who == EXAMPLE.who == ""
    assert asdict(EXAMPLE) == asdict(MillAndDie())


@pytest.mark.parametrize("who", [0, -7, 2**64, "\ud800", "a\0b", "x" * 100_000, "🙂", "王"])
def test_odd_names_get_a_machine_too(who: str | int) -> None:
    assert machine_for(who) != EXAMPLE


@pytest.mark.parametrize(
    "who", [None, 7.0, math.nan, True, False, [], ["Anna"], {}, b"Anna", object(), Ellipsis, 7j]
)
def test_what_is_neither_name_nor_number_is_refused_in_words(who: object) -> None:
    with pytest.raises(cm.InputError, match=r"name or a whole number, not .*: give .* or 17\.$"):
        machine_for(who)


def test_a_number_too_long_to_be_written_out_is_refused_in_words() -> None:
    with pytest.raises(cm.InputError, match="too long: give a shorter one, for example 17"):
        machine_for(10**5000)


def test_a_machine_says_its_numbers() -> None:
    said = str(machine_for("Anna"))
    assert said.startswith("The machine of Anna: ")
    assert f"{machine_for('Anna').rate_per_hour} pieces per hour" in said
    assert f"a stroke of {machine_for('Anna').stroke_mm:g} mm" in said
    assert str(EXAMPLE).startswith("The machine of the source: 2000 pieces per hour")
    assert str(machine_for()).startswith("Another machine: 2600 pieces per hour")


def test_who_it_is_does_not_make_another_machine() -> None:
    assert replace(machine_for("Anna"), who="Bert") == machine_for("Anna")


def test_the_key_on_the_page_for_teachers_is_right_for_each_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Also of all lessons at once: each number has enough digits."""
    page = (Path(__file__).parents[1] / "docs" / "teaching.md").read_text("utf-8")
    _, _, below = page.partition("**The key of a class.**")
    cell = below.split("```python\n")[1].split("```")[0]
    key = tmp_path / "key.py"
    key.write_text(cell.replace('lesson, names = "02"', 'lesson, names = ""'), "utf-8")
    runpy.run_path(str(key))
    anna, emil = (part.splitlines() for part in capsys.readouterr().out[5:].split("Emil\n"))
    assert len(anna) == len(emil) == len(EXERCISES)
    assert anna != emil
    for name, lines in {"Anna": anna, "Emil": emil}.items():
        for number, right in (line.split(maxsplit=1) for line in lines):
            answer = float(right) if re.fullmatch(r"[\d.]+", right) else right
            is_typed = isinstance(answer, float) or len(right) == 1
            assert not is_typed or is_right(EXERCISES[number], answer, machine_for(name))
