"""What the exercises on fits ask about: which shaft, which key, which letters."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, kw_only=True)
class FitNumbers:
    """What varies in an exercise on fits.

    In 11.1 the cam sits on a shaft of the first number of `shaft`, a diameter in mm, and may turn
    by `lag_deg`; in 11.2 hole and shaft are of the zones `pair` with the diameter `bore_mm`; in
    11.3 a shaft of `turned_mm` has the `grade`; in 11.4 the key of the shaft is as wide as its
    second number. As they stand here they are those of the lesson.

    >>> FitNumbers()
    FitNumbers(shaft=(40, 12), lag_deg=0.01, bore_mm=40, pair=('H7', 'g6'), turned_mm=40, grade=6)
    """

    shaft: tuple[int, int] = (40, 12)
    lag_deg: float = 0.01
    bore_mm: int = 40
    pair: tuple[str, str] = ("H7", "g6")
    turned_mm: int = 40
    grade: int = 6


FIT_CHOICES: Mapping[str, Sequence[Any]] = {
    "shaft": (
        (20, 6),
        (25, 8),
        (28, 8),
        (32, 10),
        (35, 10),
        (42, 12),
        (45, 14),
        (55, 16),
        (60, 18),
    ),
    "lag_deg": (0.02, 0.03, 0.04, 0.05, 0.06, 0.08),
    "bore_mm": (16, 22, 25, 28, 55, 60, 70, 90, 100, 110, 130, 160),
    "pair": (("H8", "f7"), ("H7", "f6"), ("H8", "d7"), ("H7", "e6"), ("H9", "d8"), ("H7", "d6")),
    "turned_mm": (12, 15, 20, 25, 60, 70, 75, 90, 100, 110, 140, 160),
    "grade": (7, 8, 9, 10),
}
"""Never the lesson's."""
