"""The running example with numbers of their own for each learner.

A name leads to other numbers of the same machine, the same ones on any day and any computer, so
that neighbours cannot copy a result but can compare how they came to it. Without a name the numbers
are not the lesson's either: its answers stand in no lesson.
"""

import hashlib
import numbers
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from cammotion.laws.catalogue import LAWS
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import InputError, shorten
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.fit_numbers import FIT_CHOICES, FitNumbers
from cammotion.teaching.follower_numbers import FOLLOWER_CHOICES, FollowerNumbers, Rod
from cammotion.teaching.law_numbers import LawNumbers
from cammotion.teaching.measured_numbers import MEASURED_CHOICES, MeasuredNumbers
from cammotion.teaching.table_numbers import TABLE_CHOICES, TableNumbers

NAMELESS = MillAndDie(
    rate_per_hour=2600,
    pitch_mm=130,
    stops=16,
    mill_angle_deg=120,
    work_deg=100,
    wait_mm=15,
    pocket_mm=37,
    margin_mm=3,
    die_mass_kg=17,
    fits=FitNumbers(
        shaft=(55, 16), lag_deg=0.03, bore_mm=70, pair=("H8", "d7"), turned_mm=90, grade=9
    ),
    laws=LawNumbers(
        powers=(3, 5),
        compared=("3-4-5 polynomial", "4-5-6-7 polynomial"),
        fastest=1.8,
        head_start=0.35,
        pause=0.2,
    ),
    table=TableNumbers(
        plate_kg=66,
        plate_mm=560,
        hole_mm=180,
        stops=10,
        station_kg=7,
        inset_mm=70,
        time_s=0.65,
        friction_N_m=55,
        law="cycloidal",
        angle_deg=110,
        slots=5,
        per_minute=36,
    ),
    measured=MeasuredNumbers(
        points=72,
        per_minute=42,
        limit=0.15,
        gives_mm=(0.05, 0.16, 0.42),
        load_N=600,
        mass_kg=52,
        folded=(30, 49),
        left=(20, 8, 13),
        stroke_mm=34,
        rank=7,
    ),
    follower=FollowerNumbers(
        rod=Rod(5, 85, 2300, 6, 82),
        jump_mm=42,
        ringing=(0.18, 18.5),
        lift_mm=12,
        lift_deg=100,
        spring_N_per_mm=8,
        pressed_mm=3.5,
        lifted_kg=2.6,
        m1_kg=8,
        m2_kg=7,
        k1_N_per_mm=240,
        k2_N_per_mm=140,
        wanted_mm=45,
        wanted_swings=1.75,
        wanted_x=0.35,
    ),
)
"""The machine of who gives no name; no number of a lesson is taken for one of its answers."""

_LAW = LAWS["cycloidal"]

_CHOICES: Mapping[str, Sequence[float]] = {
    "rate_per_hour": range(1200, 3001, 100),
    "pitch_mm": range(80, 131, 10),
    "stops": range(16, 33, 4),
    "mill_angle_deg": range(120, 171, 10),
    "work_deg": range(70, 121, 10),
    "wait_mm": range(15, 31),
    "pocket_mm": range(20, 41),
    "margin_mm": (1, 1.5, 2, 2.5, 3),
    "die_mass_kg": range(5, 31),
}
LAW_CHOICES: Mapping[str, Sequence[Any]] = {
    "powers": ((2, 4), (2, 5), (2, 6), (3, 4), (3, 5), (3, 6), (4, 5), (4, 6), (4, 8), (5, 6)),
    "compared": (
        ("Freudenstein 1-3-5", "cycloidal"),
        ("Gutman 1-3", "cycloidal"),
        ("Freudenstein 1-3", "cycloidal"),
        ("Freudenstein 1-3-5", "Freudenstein 1-3"),
        ("3-4-5 polynomial", "cycloidal"),
        ("modified trapezoid", "4-5-6-7 polynomial"),
        ("Freudenstein 1-3-5", "4-5-6-7 polynomial"),
        ("Gutman 1-3", "4-5-6-7 polynomial"),
        ("modified sine", "4-5-6-7 polynomial"),
        ("3-4-5 polynomial", "4-5-6-7 polynomial"),
        ("modified trapezoid", "3-4-5 polynomial"),
        ("modified trapezoid", "Freudenstein 1-3"),
    ),
    "fastest": (1.5, 1.6, 1.75, 1.8, 2.2, 2.25, 2.4, 2.5, 2.8, 3),
    "head_start": (0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.55, 0.6, 0.65, 0.7),
    "pause": (0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.5),
}
"""Never the source's: of those the lessons speak."""

_LEAST_DIE_DEG = 40
_LEAST_REST_DEG = 4  # what the overlapped die rests at the top


def machine_for(who: Any = "") -> MillAndDie:
    """Return the machine with the numbers of a learner, given by a name or a number.

    The same name gives the same numbers; capitals and blanks at its ends do not matter. Without
    one it is NAMELESS, which no lesson speaks of. Raises InputError for what is neither name nor
    number.

    >>> machine_for("Anna") == machine_for(" anna ")
    True
    >>> machine_for() == NAMELESS != EXAMPLE
    True
    """
    if isinstance(who, bool) or not isinstance(who, str | numbers.Integral):
        raise InputError(
            f"A variant is asked for by a name or a whole number, not {shorten(who)}: give for "
            "example 'Anna' or 17."
        )
    try:
        name = unicodedata.normalize("NFKC", str(who)).strip()
    except ValueError:  # Python writes out no more than 4300 digits
        raise InputError(
            "The number of a variant is too long: give a shorter one, for example 17."
        ) from None
    if not name:
        return NAMELESS
    return next(drawn(name.casefold(), name))


def drawn(seed: str, who: str) -> Iterator[MillAndDie]:
    """Yield sensible machines with drawn numbers, without an end; they depend on the seed alone.

    >>> next(drawn("anna", "Anna")) == machine_for("Anna")
    True
    """
    fits = _choices(f"{seed}|fits", FIT_CHOICES)
    laws = _choices(f"{seed}|laws", LAW_CHOICES)  # apart, so that they move no other number
    tables = _choices(f"{seed}|table", TABLE_CHOICES)
    measured = _choices(f"{seed}|measured", MEASURED_CHOICES)
    followers = _choices(f"{seed}|follower", FOLLOWER_CHOICES)
    for chosen in _choices(seed, _CHOICES):
        machine = MillAndDie(who=who, **chosen)
        if _is_sensible(machine):
            yield replace(
                machine,
                laws=LawNumbers(**next(laws)),
                table=TableNumbers(**next(tables)),
                measured=MeasuredNumbers(**next(measured)),
                follower=FollowerNumbers(**next(followers)),
                fits=FitNumbers(**next(fits)),
            )


def _choices(seed: str, among: Mapping[str, Sequence[Any]]) -> Iterator[dict[str, Any]]:
    """Yield one of its choices for each name, again and again."""
    numbers = _draws(seed)
    while True:
        yield {name: choices[next(numbers) % len(choices)] for name, choices in among.items()}


def _draws(seed: str) -> Iterator[int]:
    """Yield whole numbers, by a hash: the same with any version of Python."""
    count = 0
    while True:
        drawn = hashlib.sha256(f"{seed}|{count}".encode("utf-8", "surrogatepass"))
        yield int.from_bytes(drawn.digest()[:8])
        count += 1


def _is_sensible(machine: MillAndDie) -> bool:
    """Tell whether the die has room without overlap, and the turn has room for its widest move."""
    if machine.die_angle_deg < _LEAST_DIE_DEG or machine.limit_mm > 0.7 * machine.stroke_mm:
        return False
    before = _LAW.inverse(machine.limit_mm / machine.stroke_mm)
    widest = machine.overlapped_deg / (1 - before)
    rest = DEG_PER_TURN - machine.work_deg - 2 * widest
    return rest >= _LEAST_REST_DEG and machine != EXAMPLE
