"""The running example with numbers of their own for each learner.

A name leads to other numbers of the same machine, the same ones on any day and any computer, so
that neighbours cannot copy a result but can compare how they came to it. Without a name the numbers
are not the lesson's either: its answers stand in no lesson.
"""

import hashlib
import numbers
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from cammotion.laws.catalogue import LAWS
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import InputError, shorten
from cammotion.teaching.example import EXAMPLE, MillAndDie

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
    return next(filter(_is_sensible, _machines(name)))


def _machines(who: str) -> Iterator[MillAndDie]:
    """Yield machines with drawn numbers, without an end; the draw depends on the name alone."""
    numbers = _draws(who.casefold())
    while True:
        drawn: dict[str, Any] = {
            name: choices[next(numbers) % len(choices)] for name, choices in _CHOICES.items()
        }
        yield MillAndDie(who=who, **drawn)


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
