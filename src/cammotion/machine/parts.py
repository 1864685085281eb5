"""A motion said in words: rise 50 mm over 55 deg, dwell 100, return 50 over 55, dwell 150."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from cammotion.laws.catalogue import as_law, polynomial
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.kinematics import STROKE
from cammotion.machine.motions import Motion
from cammotion.machine.segments import CAM_ANGLE, POSITION, Segment, part_angle
from cammotion.quantities import InputError, decimals_of, is_real, shorten

_DECIMALS = 9  # of positions in mm; where all strokes are below 1 mm, as many digits

MATCHED = "matched"
"""For the law of a rise or a return: the polynomial of degree five that goes on at both ends with
the velocity and the acceleration of its neighbours, as where a shear comes up to speed. It may
swing beyond the ends of the move."""


@dataclass(frozen=True)
class Part:
    """What is said of a segment before it has its place; made by `rise`, `return_` and `dwell`."""

    angle_deg: float
    change_mm: float = 0.0
    law: str | MotionLaw | None = None


def rise(stroke_mm: float, *, over_deg: float, law: str | MotionLaw = "cycloidal") -> Part:
    """Return a rise by `stroke_mm` over a cam angle of `over_deg`, for `motion`.

    Both are numbers above 0, the angle at most 360 deg. `law` is the name of a motion law, a law,
    or `MATCHED`. Raises InputError for others.
    """
    return _move(1, stroke_mm, over_deg, law)


def return_(stroke_mm: float, *, over_deg: float, law: str | MotionLaw = "cycloidal") -> Part:
    """Return a return by `stroke_mm` over a cam angle of `over_deg`, for `motion`.

    Both are numbers above 0, the angle at most 360 deg. `law` is the name of a motion law, a law,
    or `MATCHED`. Raises InputError for others. (The plain word `return` belongs to Python.)
    """
    return _move(-1, stroke_mm, over_deg, law)


def dwell(angle_deg: float) -> Part:
    """Return a dwell over `angle_deg`, a number above 0 and at most 360 deg."""
    return Part(part_angle(angle_deg))


def _move(way: int, stroke_mm: float, over_deg: float, law: str | MotionLaw) -> Part:
    return Part(
        part_angle(over_deg),
        way * _stroke(way, stroke_mm),
        MATCHED if isinstance(law, str) and law.casefold() == MATCHED else as_law(law),
    )


def _stroke(way: int, stroke_mm: float) -> float:
    if is_real(stroke_mm) and -math.inf < stroke_mm < 0:
        other = "down is a return_" if way > 0 else "up is a rise"
        raise InputError(
            f"The stroke is {stroke_mm:g} mm; it has to be a finite number above 0 mm, and the way "
            f"{other}({-stroke_mm:g}, over_deg=...): give for example 50 mm."
        )
    return STROKE.number(stroke_mm)


def motion(name: str, *parts: Part, start_deg: float = 0, start_mm: float = 0) -> Motion:
    """Return the motion that begins at an angle and a position and goes on part by part.

    The parts are made by `rise`, `return_` and `dwell`; together they fill 360 deg and come back.
    Raises InputError if they do not.

    >>> import cammotion as cm
    >>> die = cm.motion(
    ...     "die", cm.rise(50, over_deg=55), cm.dwell(100),
    ...     cm.return_(50, over_deg=55), cm.dwell(150), start_deg=150)
    >>> die.position_mm([150, 177.5, 205, 305, 360])
    array([ 0., 25., 50., 50.,  0.])
    """
    return Motion(name, _place(name, parts, start_deg, start_mm))


def indexing_motion(
    name: str, *parts: Part, stops: int, start_deg: float = 0, start_mm: float = 0
) -> Motion:
    """Return a motion that goes on part by part from stop to stop, one pitch each turn.

    The parts, made by `rise`, `return_` and `dwell`, fill 360 deg, and its stops are where a turn
    begins: a dwell between two moves of one turn is none, whatever a rule says of a stop. `stops`
    pitches close the turret. Raises InputError unless the parts do so.

    >>> import cammotion as cm
    >>> mill = cm.indexing_motion("mill", cm.rise(100, over_deg=150), cm.dwell(210), stops=24)
    >>> mill.pitch_mm
    100.0
    """
    return Motion(name, _place(name, parts, start_deg, start_mm), stops)


def _place(name: str, parts: Sequence[Any], start_deg: float, start_mm: float) -> list[Segment]:
    """Lay the parts one after the other."""
    for part in parts:
        if not isinstance(part, Part):
            raise InputError(
                f"A part of {name!r} is {shorten(part)}: make each with rise(50, over_deg=55), "
                "dwell(100) or return_(50, over_deg=55)."
            )
    longest = max((abs(part.change_mm) for part in parts), default=0.0)
    decimals = decimals_of(longest, _DECIMALS) if longest > 0.1**_DECIMALS else _DECIMALS
    ways = [POSITION.number(start_mm)]
    angle, height = CAM_ANGLE.number(start_deg), round(ways[0], decimals)
    placed: list[dict[str, Any]] = []
    for part in parts:
        ends = angle + part.angle_deg
        ways.append(part.change_mm)
        to_mm = round(math.fsum(ways), decimals)  # 0.1 + 0.2 - 0.3 is 0 on any machine
        placed.append(
            {"from_deg": angle, "to_deg": ends, "from_mm": height, "to_mm": to_mm, "law": part.law}
        )
        angle, height = ends, to_mm
    segments = [None if part["law"] == MATCHED else Segment(**part) for part in placed]
    return [
        segment or _matched(name, placed[n], segments[n - 1], segments[(n + 1) % len(segments)])
        for n, segment in enumerate(segments)
    ]


def _matched(
    name: str, part: dict[str, Any], before: Segment | None, after: Segment | None
) -> Segment:
    """Return the move that goes on with what its neighbours have at both ends."""
    if before is None or after is None:
        raise InputError(
            f"The move of {name!r} from {part['from_deg']:g} to {part['to_deg']:g} deg is to be "
            "matched to one that is to be matched too: give one of them a law of its own."
        )
    way, angle = part["to_mm"] - part["from_mm"] or 1.0, part["to_deg"] - part["from_deg"]
    slopes = [
        [segment.curve.derived(n).ends[which] * angle**n / way for n in (1, 2)]
        for segment, which in ((before, 1), (after, 0))
    ]
    values = (value + 0.0 for each in slopes for value in each)  # no -0
    title = "matched, {:.6g} {:.6g} to {:.6g} {:.6g}".format(*values)
    law = polynomial((0, *slopes[0]), (1, *slopes[1]), name=title, may_leave=True)
    return Segment(**part | {"law": law})
