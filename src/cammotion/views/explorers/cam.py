"""The explorer of a disc cam: its prime circle, the follower's offset and the roller."""

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import sympy as sp

from cammotion.arguments import checked
from cammotion.hardware.disc_cam import check_motion
from cammotion.hardware.followers import PRIME as PRIME_MM
from cammotion.hardware.followers import ROLLER as ROLLER_MM
from cammotion.hardware.followers import TranslatingRoller
from cammotion.hardware.prime_circle import smallest_prime_radius
from cammotion.laws.catalogue import as_law
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.views.explorers.moving import ALPHA, Moving, Part, control, of_lengths, sized, tens
from cammotion.views.live.explore import explore
from cammotion.views.live.expressions import NOW
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.formulas import largest
from cammotion.views.live.parts import ALARM, FRAME, REFERENCE, Control, Line, Panel, Point, Say

PRIME, OFFSET, ROLLER = sp.symbols("R_p e r", real=True)
_RULE_DEG = 30  # the pressure angle that is usual at most, for a slide
_SECONDS = 8
_CAM_PX, _CURVE_PX = 330, 150
_TURN = (ALPHA, 0, DEG_PER_TURN)
_RAD = sp.pi / 180
_PRIMES_MM = 15, 30  # and ten times as many, for which the spans of the other controls are made
_COARSEST = 4  # times the smallest prime circle is the largest to be tried
_ROOM = PRIME - sp.Max(sp.Abs(OFFSET), ROLLER, evaluate=False)  # there is a cam where it is above 0


class _Curves(NamedTuple):
    """The pitch curve in the machine's frame, its direction, and what is judged by it."""

    across: sp.Expr  # of the roller's centre, in mm
    height: sp.Expr
    normal: tuple[sp.Expr, sp.Expr]  # outwards, of length 1
    pressure_deg: sp.Expr
    sharpness: sp.Expr  # the roller's radius over that of the pitch curve


@checked
def explore_cam(
    motion: Motion, *, roller_radius_mm: float = 10, prime_radius_mm: float = 60
) -> LiveFigure:
    """Return a live figure of the disc cam of a motion, whose follower is a roller on a slide.

    The controls are the radius of the prime circle, the offset of the slide and the radius of the
    roller, all in mm. Left the cam turns under its follower; right are the pressure angle, and the
    roller's radius over that of the pitch curve, which is an undercut where it is above 1. Where
    the prime circle is not larger than offset and roller there is no cam, which is said. Raises
    InputError for a motion that no disc cam can give.

    >>> import cammotion as cm
    >>> figure = explore_cam(cm.EXAMPLE.die)
    >>> figure.values = {PRIME: 156.835}
    >>> print(figure.text.splitlines()[0])
    pressure angle: up to 30 deg
    """
    check_motion(motion)
    roller_radius_mm, prime_radius_mm = (
        ROLLER_MM.number(roller_radius_mm),
        PRIME_MM.number(prime_radius_mm),
    )
    least = smallest_prime_radius(motion, TranslatingRoller(roller_radius_mm))
    curves = _curves(motion)
    times = tens(prime_radius_mm, *_PRIMES_MM)
    tried = max(_COARSEST * prime_radius_mm, 1.5 * least) / times
    primes, offsets, rollers = (
        sized(span, times) for span in ((15, _rounded_up(tried), 1), (-30, 30, 1), (3, 30, 1))
    )
    low, high, step = offsets
    return explore(
        [[_cam(curves, motion)], _judged(curves)],
        _TURN,
        {
            PRIME: control("prime circle Rp", primes, prime_radius_mm, "mm"),
            OFFSET: Control(low=low, high=high, step=step, start=0, name="offset e", unit="mm"),
            ROLLER: control("roller r", rollers, roller_radius_mm, "mm"),
        },
        says=_sentences(curves, motion, of_lengths(primes[1])),
        clock=ALPHA,
        seconds=_SECONDS,
        shares=(1, 1),
        title="A disc cam",
    )


def _curves(motion: Motion) -> _Curves:
    moving = _moving(motion)
    lift = moving.position() - sp.Float(motion.range_mm[0])
    slope, bend = moving.by_rad(1), moving.by_rad(2)
    height = sp.sqrt(sp.Max(PRIME**2 - OFFSET**2, 0, evaluate=False)) + lift
    beside = slope - OFFSET
    length = sp.sqrt(height**2 + beside**2)
    turn = height**2 - height * bend + beside * (2 * slope - OFFSET)
    return _Curves(
        -OFFSET,
        height,
        (beside / length, height / length),
        sp.atan2(beside, height) * 180 / sp.pi,
        ROLLER * turn / length**3,
    )


def _moving(motion: Motion) -> Moving:
    parts = tuple(
        Part(s.angle_deg, s.change_mm, None if s.is_dwell else as_law(s.law))
        for s in motion.segments
    )
    return Moving(motion.start_deg, parts, start_mm=motion.start_mm)


def _cam(curves: _Curves, motion: Motion) -> Panel:
    low, high = motion.range_mm
    reach = PRIME + sp.Float(high - low) + sp.Rational(3, 2) * ROLLER
    centre = curves.across, curves.height.xreplace({ALPHA: NOW})
    round_about = sp.cos(_RAD * ALPHA), sp.sin(_RAD * ALPHA)
    pitch = curves.across, curves.height
    profile = [at - ROLLER * out for at, out in zip(pitch, curves.normal, strict=True)]
    return Panel(
        lines=[
            Line(
                x=PRIME * round_about[0],
                y=PRIME * round_about[1],
                name="prime circle",
                role=REFERENCE,
            ),
            _seen(pitch, name="pitch curve", role=FRAME, only_where=_ROOM),
            _seen(profile, name="cam", colour=0, only_where=_ROOM),
            _seen(
                profile,
                name="undercut",
                role=ALARM,
                only_where=_undercut(curves),
            ),
            Line(
                x=centre[0] + ROLLER * round_about[0],
                y=centre[1] + ROLLER * round_about[1],
                name="roller",
                colour=1,
            ),
            Line(x=centre[0], y=centre[1] + reach * ALPHA / DEG_PER_TURN, role=FRAME),
        ],
        points=[Point(x=0, y=0, colour=5)],
        is_equal=True,
        is_bare=True,
        x_limits=(-reach, reach),
        y_limits=(-reach, reach),
        x="",
        height=_CAM_PX,
        title="The cam turns clockwise",
    )


def _undercut(curves: _Curves) -> sp.Expr:
    """Return what is above 0 where a cam that can be is undercut."""
    return sp.Min(curves.sharpness - 1, _ROOM, evaluate=False)


def _seen(place: Sequence[sp.Expr], **how: Any) -> Line:
    """Return a curve of the cam as it stands in the machine when the clock has turned it."""
    turn = _RAD * (ALPHA - NOW)
    across, up = place
    return Line(
        x=across * sp.cos(turn) - up * sp.sin(turn),
        y=across * sp.sin(turn) + up * sp.cos(turn),
        **how,
    )


def _judged(curves: _Curves) -> list[Panel]:
    pressure, sharpness = curves.pressure_deg, curves.sharpness
    limits = [Line(y=side * _RULE_DEG, role=REFERENCE) for side in (1, -1)]
    return [
        Panel(
            lines=[Line(y=pressure, colour=0, only_where=_ROOM), *limits],
            points=[Point(x=NOW, y=pressure.xreplace({ALPHA: NOW}))],
            y="pressure angle in deg",
            y_limits=(-75, 75),
            y_ticks=30,
            height=_CURVE_PX,
        ),
        Panel(
            lines=[
                Line(y=sharpness, colour=0, only_where=_ROOM),
                Line(y=sharpness, role=ALARM, only_where=_undercut(curves)),
                Line(y=1, role=REFERENCE),
            ],
            y="roller over radius",
            y_limits=(-1.5, 1.5),
            y_ticks=1,
            height=_CURVE_PX,
        ),
    ]


def _sentences(curves: _Curves, motion: Motion, mm: str) -> Iterator[Say]:
    most = _largest(curves.sharpness, motion)
    steepest = _largest(sp.Abs(curves.pressure_deg, evaluate=False), motion)
    numbers = {"radius": ROLLER / most, "roller": ROLLER, "times": 1 / most}
    finer = f".{int(mm[1:-1]) + 1}g"  # a radius that is hardly too small looks so
    yield Say(
        f"NO CAM: the prime circle has a radius of {{prime:{mm}}} mm, and has to be larger than "
        f"the offset, {{offset:{mm}}} mm, and the roller, {{roller:{mm}}} mm",
        {"prime": PRIME, "offset": OFFSET, "roller": ROLLER},
        _ROOM <= 0,
        Say("pressure angle: up to {angle:.3g} deg", {"angle": steepest}),
    )
    yield Say(
        f"UNDERCUT: at its sharpest the pitch curve has a radius of {{radius:{finer}}} mm, and the "
        f"roller one of {{roller:{mm}}} mm",
        numbers,
        (_ROOM > 0) & (most > 1),
        Say(
            f"at its sharpest the pitch curve has a radius of {{radius:{mm}}} mm, "
            "{times:.3g} times the roller's",
            numbers,
            _ROOM > 0,
        ),
    )


def _largest(expression: sp.Expr, motion: Motion) -> sp.Expr:
    """Return the largest value over the turn, searched for in each segment, however short it is."""
    spans = [(ALPHA, segment.from_deg, segment.to_deg) for segment in motion.segments]
    return sp.Max(*(largest(expression, span) for span in spans), evaluate=False)


def _rounded_up(number: float) -> float:
    return math.ceil(number / 20) * 20.0
