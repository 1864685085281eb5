"""What the exercises on a cam ask about: its circles and its spring, by the die's own numbers."""

import math
from typing import NamedTuple

from cammotion.laws.catalogue import LAWS

HARDEST = 3 / 4  # x at which the cycloid brakes hardest
_SPARE_MM = 25  # that the base circle is larger than a point would need
_SPRING_SHARE = 0.4  # of the push, that the spring gains by being pressed together
_UNSEEN = (0.5, 1.0, 2.0)  # N/mm, for which forgotten or one too many is right, or another reason


class CamNumbers(NamedTuple):
    """The prime circle of 07.1, the base circle of 07.4, both by their radius, the spring of 07.5.

    >>> LESSONS_CAM.spring_N_per_mm
    0.5
    """

    prime_mm: float
    base_mm: float
    spring_N_per_mm: float  # noqa: N815 (units)


LESSONS_CAM = CamNumbers(60, 296, 0.5)
"""That of the lesson, whose numbers do not follow from its die's."""


def bend_mm(stroke_mm: float, angle_deg: float) -> float:
    """Return the cycloid's largest second derivative by the cam angle, in mm/rad².

    >>> print(f"{bend_mm(50, 55):.2f}")
    340.93
    """
    return 2 * math.pi * stroke_mm / math.radians(angle_deg) ** 2


def cam_numbers(stroke_mm: float, angle_deg: float, push_N: float) -> CamNumbers:  # noqa: N803
    """Return the cam that is asked about, for a die that is braked by `push_N` at the hardest.

    The prime circle is about two strokes, the base circle a little larger than is needed. The
    spring has one digit; it is a tenth less where that would hide that it was forgotten, or make it
    a factor 2.

    >>> cam_numbers(50, 55, 49.9)
    CamNumbers(prime_mm=100, base_mm=330, spring_N_per_mm=0.4)
    """
    hardest_mm = stroke_mm * float(LAWS["cycloidal"](HARDEST))
    needed_mm = bend_mm(stroke_mm, angle_deg) - hardest_mm
    rounded = float(f"{_SPRING_SHARE * push_N / hardest_mm:.1g}")
    return CamNumbers(
        10 * round(stroke_mm / 5),
        10 * math.ceil((needed_mm + _SPARE_MM) / 10),
        0.9 * rounded if rounded in _UNSEEN else rounded,
    )
