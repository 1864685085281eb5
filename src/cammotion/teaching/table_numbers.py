"""What the exercises on an indexer ask about: a table of one's own."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, kw_only=True)
class TableNumbers:
    """A table with `stops` stations, and a Geneva wheel; lengths in mm, masses in kg.

    The plate is round, with a round hole; each station is a mass on a radius. An index takes
    `time_s`, while the camshaft turns by `angle_deg`. The driver of the wheel with `slots` slots
    turns `per_minute` times a minute. As they stand here they are those of the source; it has no
    hole, and no such wheel.

    >>> TableNumbers().stops, TableNumbers().plate_kg
    (8, 43.04)
    """

    plate_kg: float = 43.04
    plate_mm: float = 500
    hole_mm: float = 0
    stops: int = 8
    station_kg: float = 20
    inset_mm: float = 50
    time_s: float = 0.75
    friction_N_m: float = 10  # noqa: N815 (units)
    law: str = "modified sine"
    angle_deg: float = 150
    slots: int = 8
    per_minute: float = 30

    @property
    def radius_mm(self) -> float:
        """The radius on which the stations are."""
        return self.plate_mm - self.inset_mm


TABLE_CHOICES: Mapping[str, Sequence[Any]] = {
    "plate_kg": (48, 54, 60, 66, 72, 80, 90),
    "plate_mm": (420, 460, 520, 560, 600),
    "hole_mm": (140, 150, 160, 180, 200, 220),
    "stops": (5, 6, 9, 10, 12),
    "station_kg": (4, 5, 6, 7, 9, 10),
    "inset_mm": (60, 70, 80, 90, 110),
    "time_s": (0.5, 0.55, 0.6, 0.65, 0.7, 0.8),
    "friction_N_m": (40, 45, 55, 60, 70, 80),
    "law": ("cycloidal", "modified trapezoid", "3-4-5 polynomial"),
    "angle_deg": (90, 100, 110, 120, 135, 160),
    "slots": (7, 5, 14, 11, 12),  # of 4, 6, 10 half-way is 1, 2, 4 times pi/2n; 9: the largest
    "per_minute": (24, 28, 32, 36, 40, 45),
}
"""Never the source's: of those the lesson speaks."""
