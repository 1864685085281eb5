"""What the exercises on the follower's vibration ask about: other slides, other cams."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple


class Rod(NamedTuple):
    """A slide of `slide_kg` that swings on a lever and a rod, one behind the other.

    It rises over `rise_deg` at `per_hour`, shall swing `swings` times meanwhile, and the lever has
    `lever_N_per_mm`.
    """

    slide_kg: float
    rise_deg: float
    per_hour: int
    swings: int
    lever_N_per_mm: float  # noqa: N815 (units)


_LESSONS = Rod(12, 124.8, 2000, 10, 150)


@dataclass(frozen=True, kw_only=True)
class FollowerNumbers:
    """What varies in an exercise on the follower's vibration.

    In 10.1 a slide rises, see `Rod`. In 10.2 the constant acceleration lifts one by `jump_mm`, and
    `ringing` is the time of that in s with its frequency in Hz. In 10.3 a level follower of
    `lifted_kg` is lifted by `lift_mm` over `lift_deg`; its spring of `spring_N_per_mm` is pressed
    together by `pressed_mm` at the lowest position. In 10.4 `m1_kg` and `m2_kg` follow the cam on
    `k1_N_per_mm` and `k2_N_per_mm`. In 10.5 a mass that swings `wanted_swings` times in a move of
    `wanted_mm` is looked at when the share `wanted_x` of the time is over. As they stand here they
    are those of the lesson and of its sources.

    >>> FollowerNumbers().rod.slide_kg, FollowerNumbers().lift_deg
    (12, 120)
    """

    rod: Rod = _LESSONS
    jump_mm: float = 50
    ringing: tuple[float, float] = (0.275, 17.8)
    lift_mm: float = 10
    lift_deg: float = 120
    spring_N_per_mm: float = 15  # noqa: N815 (units)
    pressed_mm: float = 2.5
    lifted_kg: float = 1.8
    m1_kg: float = 1
    m2_kg: float = 1
    k1_N_per_mm: float = 1  # noqa: N815
    k2_N_per_mm: float = 1  # noqa: N815
    wanted_mm: float = 50
    wanted_swings: float = 2.5
    wanted_x: float = 0.25


FOLLOWER_CHOICES: Mapping[str, Sequence[Any]] = {
    "rod": (
        Rod(9, 80, 2400, 6, 150),
        Rod(14, 95, 2200, 7, 180),
        Rod(7, 70, 1800, 5, 62),
        Rod(18, 110, 1500, 8, 110),
        Rod(11, 65, 1600, 6, 140),
        Rod(16, 100, 2700, 5, 190),
        Rod(8, 90, 3000, 7, 230),
        Rod(21, 75, 1200, 8, 200),
        Rod(6, 105, 2800, 6, 76),
        Rod(13, 85, 1400, 7, 78),
        Rod(24, 115, 1900, 5, 110),
    ),
    "jump_mm": (18, 24, 30, 36, 42, 60, 75),
    "ringing": (
        (0.14, 10),
        (0.12, 14),
        (0.16, 15.2),
        (0.2, 13),
        (0.15, 18),
        (0.18, 18.5),
        (0.25, 13.5),
        (0.24, 19),
        (0.32, 13.8),
        (0.2, 16.8),
        (0.22, 12),
    ),
    "lift_mm": (8, 9, 12, 14, 15, 16),
    "lift_deg": (80, 90, 100, 110, 130, 140, 150),
    "spring_N_per_mm": (6, 8, 10, 12, 18, 20),
    "pressed_mm": (1.5, 2, 3, 3.5, 4),
    "lifted_kg": (0.9, 1.2, 1.5, 2.2, 2.6, 3.1),
    "m1_kg": (3, 4, 6, 8),
    "m2_kg": (10, 11, 7, 9),  # with 2 or 5 a wrong way of 10.4 could lead to the right number
    "k1_N_per_mm": (180, 240, 320, 450),
    "k2_N_per_mm": (90, 140, 210, 260),
    "wanted_mm": (12, 16, 20, 28, 36, 45),
    "wanted_swings": (1.4, 1.6, 1.75, 1.9, 2.2, 2.4, 2.75, 3),
    "wanted_x": (0.2, 0.3, 0.35, 0.65, 0.7, 0.8),
}
"""Never the lesson's, nor its sources'."""
