"""Limits and fits by ISO 286: how far a shaft and a hole may be from their nominal size.

The formulas are for understanding. A drawing takes the table, which is not the rounded formula.
"""

import math
import re
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np

from cammotion.arguments import checked
from cammotion.hardware.iso_286 import (
    GRADES,
    LAST_GRADE_OF_K,
    LOWER,
    STEPS_MM,
    SYMMETRIC,
    UPPER,
)
from cammotion.machine.kinematics import UM_PER_MM
from cammotion.quantities import InputError, Quantity, keep_numbers, one_of, shorten, to_the_letter

Kind = Literal["clearance", "transition", "interference"]

_DIAMETER = Quantity("diameter", "mm", example=40, high=STEPS_MM[-1])
_DEVIATION = Quantity("deviation", "µm", example=-9, low=-1e6, high=1e6)
_LETTERS = (*UPPER, SYMMETRIC, *LOWER)
_UNITS = {5: 7, 6: 10, 7: 16, 8: 25, 9: 40, 10: 64, 11: 100}
_POWERS = {  # um = factor * mm ** power, with the sign of the deviation
    "d": (-16, 0.44),
    "e": (-11, 0.41),
    "f": (-5.5, 0.41),
    "g": (-2.5, 0.34),
    "h": (0, 1),
    "k": (0.6, 1 / 3),
    "n": (5, 0.34),
}
ZONE = r"([A-Za-z]+)\s*(\d{1,4})"
_HOLE, _SHAFT = r"([A-Z][A-Za-z]*)\s*(\d{1,4})", r"([a-z][A-Za-z]*)\s*(\d{1,4})"
_SIZE = r"\s*[⌀Øø∅φΦϕ]?\s*(\d+(?:\.\d+)?)\s*(?:mm)?\s*"
_MENDED = {
    "with a point for the comma": (",", "."),
    "with the hole first": (f"{_SHAFT}\\s*/\\s*{_HOLE}", r"\3\4/\1\2"),
}
"""How a designation is written otherwise than it was given."""


def size_step_mm(diameter_mm: float) -> tuple[float, float]:
    """Return the step of sizes that a diameter in mm lies in: from over the first to the second.

    All diameters of a step have the same tolerances. The first step, up to 3 mm, is reckoned from
    1 mm on. Raises InputError outside 0 to 500 mm.

    >>> size_step_mm(40), size_step_mm(50), size_step_mm(2)
    ((30, 50), (30, 50), (1, 3))
    """
    at = _step(diameter_mm)
    return (STEPS_MM[at - 1] if at else 1), STEPS_MM[at]


def mean_diameter_mm(diameter_mm: float) -> float:
    """Return the geometric mean of the step of a diameter, in mm, which the formulas reckon with.

    Raises InputError outside 0 to 500 mm.

    >>> print(f"{mean_diameter_mm(40):.2f}")
    38.73
    """
    return math.sqrt(math.prod(size_step_mm(diameter_mm)))


def tolerance_unit(diameter_mm: float) -> float:
    """Return the tolerance unit i at a diameter in mm, in um: 0.45 D^(1/3) + 0.001 D.

    D is the geometric mean of the diameter's step. Raises InputError outside 0 to 500 mm.

    >>> print(f"{tolerance_unit(40):.3f}")
    1.561
    """
    mean = mean_diameter_mm(diameter_mm)
    return float(0.45 * mean ** (1 / 3) + 0.001 * mean)


def grade_um(diameter_mm: float, grade: int) -> float:
    """Return how wide a grade is by the formula, in um: grade 6 is 10 tolerance units.

    For a drawing take `limits_of`. Raises InputError for a diameter outside 0 to 500 mm and for a
    grade other than 5 to 11.

    >>> print(f"{grade_um(40, 6):.1f}")
    15.6
    """
    return _UNITS[_checked_grade(grade)] * tolerance_unit(diameter_mm)


def deviation_um(diameter_mm: float, letter: str) -> float:
    """Return the fundamental deviation of a shaft's letter by the formula, in um.

    It is the upper one for d, e, f, g and h and the lower one for k and n, for which the formula is
    a power of the mean diameter. For a drawing take `limits_of`. Raises InputError for another
    letter, and for a diameter outside 0 to 500 mm.

    >>> print(f"{deviation_um(40, 'g'):.1f}")
    -8.7
    """
    factor, power = _POWERS[one_of("formula here for the letter", letter, _POWERS, is_exact=True)]
    return float(factor * mean_diameter_mm(diameter_mm) ** power)


@checked
@dataclass(frozen=True, repr=False)
class Limits:
    """How far a part may be from its nominal size: a diameter in mm, deviations in um.

    Raises InputError for numbers out of range and for deviations the wrong way round.

    >>> Limits(40, "g6", upper_um=-9, lower_um=-25)
    40 g6: -9/-25 µm
    """

    diameter_mm: float
    zone: str
    upper_um: float
    lower_um: float

    def __post_init__(self) -> None:
        read = read_deviation
        keep_numbers(self, diameter_mm=_DIAMETER.number, upper_um=read, lower_um=read)
        if self.width_um < 0:
            raise InputError(
                f"The upper deviation is {self.upper_um:g} µm and the lower one {self.lower_um:g}: "
                "give the larger one as upper_um."
            )

    def __repr__(self) -> str:
        """Write it as a drawing does."""
        upper, lower = self.signed
        return f"{self.diameter_mm:g} {self.zone}: {upper}/{lower} µm"

    @property
    def signed(self) -> tuple[str, str]:
        """The upper and the lower deviation in um as they are written: +25, -9, or 0."""
        return as_written(self.upper_um), as_written(self.lower_um)

    @property
    def width_um(self) -> float:
        """The tolerance: upper less lower deviation."""
        return self.upper_um - self.lower_um

    @property
    def largest_mm(self) -> float:
        """The largest size that is good, in mm."""
        return self.diameter_mm + self.upper_um / UM_PER_MM

    @property
    def smallest_mm(self) -> float:
        """The smallest size that is good, in mm."""
        return self.diameter_mm + self.lower_um / UM_PER_MM


def limits_of(designation: str) -> Limits:
    """Return the limits of a shaft like "40 g6", or of a hole like "40 H7", by the table.

    Shafts have the letters d, e, f, g, h, js, k, m, n, p and s, holes F, G and H; the grades go
    from 5 to 11 and diameters up to 500 mm. Raises InputError for what cannot be read, and for what
    is not confirmed by two published tables.

    >>> limits_of("40 g6"), limits_of("40 H7")
    (40 g6: -9/-25 µm, 40 H7: +25/0 µm)
    """
    size, letter, grade = _read(
        f"{_SIZE}{ZONE}\\s*",
        designation,
        "Limits are asked for by a diameter in mm, a letter and a grade",
        "'40 g6' for a shaft or '40 H7' for a hole",
    )
    return _limits(float(size), letter, int(grade))


@dataclass(frozen=True)
class Fit:
    """A hole and a shaft of one nominal size, like "40 H7/g6": how much play there may be, in um.

    The sign of a diameter may stand before it, as in "⌀40 H7/g6". Raises InputError for what cannot
    be read, for hole and shaft exchanged, and for limits that are not confirmed.

    >>> fit = Fit("40 H7/g6")
    >>> fit.smallest_clearance_um, fit.largest_clearance_um, fit.kind
    (9, 50, 'clearance')
    """

    designation: str

    def __post_init__(self) -> None:
        _ = self._parts  # what is wrong is said at once

    @property
    def hole(self) -> Limits:
        """The limits of the hole."""
        return self._parts[0]

    @property
    def shaft(self) -> Limits:
        """The limits of the shaft."""
        return self._parts[1]

    @property
    def largest_clearance_um(self) -> float:
        """The play of the largest hole and the thinnest shaft, in um; interference is negative."""
        return self.hole.upper_um - self.shaft.lower_um

    @property
    def smallest_clearance_um(self) -> float:
        """The play of the smallest hole and the thickest shaft, in um; interference is negative."""
        return self.hole.lower_um - self.shaft.upper_um

    @property
    def kind(self) -> Kind:
        """Whether all pairs have clearance, or all interference, or some the one, some the other.

        >>> [Fit(f"40 H7/{shaft}").kind for shaft in ("g6", "k6", "p6")]
        ['clearance', 'transition', 'interference']
        """
        if self.smallest_clearance_um >= 0:
            return "clearance"
        return "interference" if self.largest_clearance_um <= 0 else "transition"

    @property
    def summary(self) -> str:
        """The kind with how much of it there may be.

        >>> for shaft in ("g6", "k6", "p6"):
        ...     print(Fit(f"40 H7/{shaft}").summary)
        clearance, 9 to 50 µm
        transition, from 18 µm of interference to 23 µm of clearance
        interference, 1 to 42 µm
        """
        least, most = self.smallest_clearance_um, self.largest_clearance_um
        if self.kind == "transition":
            return f"transition, from {-least:g} µm of interference to {most:g} µm of clearance"
        low, high = sorted((abs(least), abs(most)))
        return f"{self.kind}, {low:g} to {high:g} µm"

    @cached_property
    def _parts(self) -> tuple[Limits, Limits]:
        size, hole, its_grade, shaft, grade = _read(
            f"{_SIZE}{_HOLE}\\s*/\\s*{_SHAFT}\\s*",
            self.designation,
            "A fit is a diameter in mm, a hole with a capital letter and a shaft with a small one",
            "'40 H7/g6'",
        )
        return (
            _limits(float(size), hole, int(its_grade)),
            _limits(float(size), shaft, int(grade)),
        )


def _read(pattern: str, given: Any, what: str, example: str) -> tuple[str, ...]:
    """Return the parts of a designation; raise InputError that says what it is."""
    found = isinstance(given, str) and re.fullmatch(pattern, given)
    if not found:
        meant = _mended(pattern, given) or f"for example {example}"
        raise InputError(f"{what}, not {shorten(given)}: give {meant}.")
    return found.groups()


def _mended(pattern: str, given: Any) -> str:
    """Return in words how a designation is to be written, "" if that is not to be seen."""
    text = given if isinstance(given, str) else ""
    how = []
    for each, (before, after) in _MENDED.items():
        if re.search(before, text):
            text = re.sub(before, after, text)
            how.append(each)
    found = re.fullmatch(pattern, text)
    reads = found and all(part in _LETTERS for part in found.groups() if part.isalpha())
    return f"it {' and '.join(how)}, {shorten(text)}" if reads else ""


def _limits(diameter_mm: float, letter: str, grade: int) -> Limits:
    """Return the limits of a zone: a capital letter is of a hole, a small one of a shaft."""
    at = _step(diameter_mm)
    known = [each for each in _LETTERS if each.isupper() == letter[0].isupper()]
    to_the_letter("confirmed tolerance zone with the letter", letter, known)
    width = GRADES[_checked_grade(grade)][at]
    zone = f"{letter}{grade}"
    if letter == SYMMETRIC:
        return Limits(diameter_mm, zone, width / 2, -width / 2)
    deviation = (UPPER.get(letter) or LOWER[letter])[at]
    if deviation is None:
        raise InputError(_not_confirmed(diameter_mm, letter))
    if letter == "k" and grade > LAST_GRADE_OF_K:
        deviation = 0
    if letter in UPPER:
        return Limits(diameter_mm, zone, deviation, deviation - width)
    return Limits(diameter_mm, zone, deviation + width, deviation)


def _step(diameter_mm: float) -> int:
    """Return the number of the step that a diameter lies in."""
    diameter = _DIAMETER.number(diameter_mm)
    return next(at for at, high in enumerate(STEPS_MM) if diameter <= high)


def as_written(deviation_um: float) -> str:
    """Return a deviation in um as it is written."""
    return f"{deviation_um:+g}" if deviation_um else "0"


def read_deviation(value: Any) -> float:
    """Return a deviation in um, an int where it is whole; raises InputError for what is none."""
    number = _DEVIATION.number(value)
    return int(number) if number.is_integer() else number


def _checked_grade(grade: Any) -> int:
    if not isinstance(grade, int | np.integer) or grade not in (*GRADES,):
        raise InputError(
            f"The grade is {shorten(grade)}; there are the grades 5 to 11 here: give for example 7."
        )
    return int(grade)


def _not_confirmed(diameter_mm: float, letter: str) -> str:
    known = [at for at, value in enumerate(LOWER[letter]) if value is not None]
    low = f"over {STEPS_MM[known[0] - 1]} " if known[0] else ""
    high = STEPS_MM[known[-1]]
    nearest = min((STEPS_MM[at] for at in known), key=lambda size: abs(size - diameter_mm))
    return (
        f"The diameter is {diameter_mm:g} mm, and the letter {letter} is confirmed here only for "
        f"diameters {low}up to {high} mm: give for example {nearest} mm, or look it up in "
        "ISO 286-2."
    )
