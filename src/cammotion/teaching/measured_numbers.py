"""What the exercises on a measured cam ask about: another table, another follower."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, kw_only=True)
class MeasuredNumbers:
    """What varies in an exercise on a measured cam.

    In 09.1 a turn has `points` even angles, the camshaft turns `per_minute` times a minute, and the
    acceleration may be off by `limit`, in m/s2. In 09.2 three parts give way by `gives_mm` under
    `load_N`, below a follower of `mass_kg`. In 09.3 a true harmonic, the second number of `folded`,
    is seen in as many points as the first. In 09.4 a spline leaves of one harmonic a share, `left`
    being (rank, percent, another rank). In 09.5 the lift is `stroke_mm`, and `rank` is odd. As they
    stand here they are those of the lesson.

    >>> MeasuredNumbers().points, MeasuredNumbers().rank
    (36, 17)
    """

    points: int = 36
    per_minute: float = 15
    limit: float = 0.004
    gives_mm: tuple[float, float, float] = (0.03048, 0.4191, 6.0198)
    load_N: float = 444.822  # noqa: N815 (units)
    mass_kg: float = 83.91
    folded: tuple[int, int] = (36, 22)
    left: tuple[int, int, int] = (10, 50, 5)
    stroke_mm: float = 114.3
    rank: int = 17


MEASURED_CHOICES: Mapping[str, Sequence[Any]] = {
    "points": (60, 72, 90, 120),
    "per_minute": (24, 36, 42, 48, 54, 66),
    "limit": (0.06, 0.08, 0.12, 0.15, 0.18, 0.25),
    "gives_mm": (
        (0.02, 0.14, 0.35),
        (0.03, 0.12, 0.28),
        (0.05, 0.16, 0.42),
        (0.04, 0.22, 0.55),
        (0.06, 0.18, 0.32),
    ),
    "load_N": (300, 400, 500, 600, 800),
    "mass_kg": (28, 34, 45, 52, 64, 75),
    "folded": ((24, 41), (26, 43), (28, 45), (30, 49), (32, 53), (40, 67), (44, 75), (48, 79)),
    "left": ((12, 10, 7), (15, 12, 9), (20, 8, 13), (24, 15, 17), (16, 20, 11), (18, 14, 11)),
    "stroke_mm": (16, 22, 28, 34, 42, 55, 65),
    "rank": (5, 7, 9, 11, 13),
}
"""Never the lesson's."""
