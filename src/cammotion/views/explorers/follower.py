"""The explorers of the follower: a mass on a spring, driven through one rise and left alone."""

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np
import sympy as sp

from cammotion.arguments import checked
from cammotion.dynamics.one_mass import OneMass, zeta
from cammotion.dynamics.residual import dynamic_factor, residual_vibration
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.symbols import x
from cammotion.views.law_plots import as_laws
from cammotion.views.live.explore import explore
from cammotion.views.live.expressions import NOW
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.formulas import largest
from cammotion.views.live.parts import FRAME, Control, Line, Panel, Point, Say, choice

n, _SHOWN = sp.symbols("n shown", positive=True)
_LAWS = ("cycloidal", "simple harmonic", "constant acceleration")
_SPRING, _COILS, _HALF_MASS = sp.Rational(7, 10), 7, sp.Rational(3, 20)  # lengths in strokes
_END = 2.5  # of the time that is shown, in indexing times
_STIFF = 60  # a deflection of 1 is drawn as this much acceleration, unless the spring is softer
_MASS, _CAM = 0, 1  # colours: the mass, which swings, has the unbroken line
_MOST, _TICK = 20, 5  # acceleration on the axis, unless a law or its mass has more
_RARE, _OFTEN = sp.Rational(1, 2), 10  # swings during the move, between which what stays is drawn
_OFTENEST = 15  # that can be set
_SOFT, _SOFT_TICK = 24, 8  # what stays at few swings
_LIGHTEST = 0.005  # damping ratio
_OVER = 1.02  # of an axis: so little beyond its end is in the line's width
_SWINGS = 0.1  # the step of their control: at each it is seen how far a mass comes


@checked
def explore_follower(
    laws: Iterable[str | MotionLaw] = _LAWS, *, start: float = 5, damping_ratio: float = 0.02
) -> LiveFigure:
    """Return a live figure of a mass on a spring, driven by a law through one rise.

    The control n is how often the mass swings during the move, from 0.5 to 15, `start` at first.
    `laws`, names or laws, are to choose from; `damping_ratio` is dimensionless. The
    accelerations are factors like Ca, to be multiplied by hm/tm². Raises InputError as `OneMass`
    does, and where there is no law.

    >>> figure = explore_follower()
    >>> figure.values = {n: 4}
    >>> print(figure.text.splitlines()[0])
    cycloidal: largest |A| of the cam 6.28, of the mass 7.82, which is 1.24 times as much
    """
    known = as_laws(laws)
    masses = [OneMass(law, n, damping_ratio) for law in known]
    tops = [_tops(law, _OFTENEST, damping_ratio)[0] for law in known]
    curves = {
        law.name: (*_curves(law, mass), top)
        for law, mass, top in zip(known, masses, tops, strict=True)
    }
    s, a, z, of_mass, c_a, top = choice("motion law", curves)
    return explore(
        [
            _picture(*(each.xreplace({x: NOW}) for each in (s, z))),
            _over_time(a, of_mass, _axis(top, tops, _MOST, _TICK), height=190),
        ],
        (x, 0, _END),
        {
            n: Control(
                low=0.5, high=_OFTENEST, step=_SWINGS, start=start, name="swings during the move"
            )
        },
        values={_SHOWN: sp.Max(1, (2 * sp.pi * n) ** 2 / _STIFF)},
        says=list(_sentences(_chosen(c_a, known), c_a, of_mass)),
        clock=x,
        seconds=8,
        pin="Keep this one, dashed",
        title="A mass on a spring, driven by a cam",
    )


@checked
def explore_residual(
    laws: Iterable[str | MotionLaw] = _LAWS, *, start: float = 5, damping_ratio: float = 0.02
) -> LiveFigure:
    """Return a live figure of a mass on a spring, and of the swing that is left after its move.

    The controls are n, how often the mass swings during the move, from 0.5 to 10, and the damping
    ratio, from 0.005 to 0.3; `start` and `damping_ratio` are where they stand at first. `laws`,
    names or laws, are to choose from. Above is the acceleration of cam and mass over the time,
    below how large that of the mass becomes after the move, over n. All are factors like Ca, to be
    multiplied by hm/tm². Raises InputError as `OneMass` does, and where there is no law.

    >>> figure = explore_residual()
    >>> figure.values = {n: 4}
    >>> print(figure.text.splitlines()[1])
    after the move its swing has |A| up to 0.642, and is up to 0.102 percent of the stroke
    """
    known = as_laws(laws)
    masses = [OneMass(law, n, zeta) for law in known]
    swings = _RARE + (_OFTEN - _RARE) * x / _END
    tops = [_tops(law, _OFTEN, _LIGHTEST) for law in known]
    of_all, of_what_stays = zip(*tops, strict=True)
    curves = {
        law.name: (
            _acceleration(law),
            mass.a,
            *_left_behind(mass.a, n, swings),
            *_left_behind(mass.z, n),
            law.Ca,
            *highest,
        )
        for law, mass, highest in zip(known, masses, tops, strict=True)
    }
    a, of_mass, left, left_by_swings, share, c_a, top, soft = choice("motion law", curves)
    most_left, tick = _axis(soft, of_what_stays, _SOFT, _SOFT_TICK)
    return explore(
        [
            _over_time(a, of_mass, _axis(top, of_all, _MOST, _TICK), height=180),
            Panel(
                lines=[Line(x=swings, y=left_by_swings, colour=_MASS)],
                points=[Point(x=n, y=left, name="now", colour=_CAM)],
                x="swings during the move, n = tm/Tn",
                y="|A| after the move",
                x_limits=(0, _OFTEN),
                y_limits=(0, most_left),
                y_ticks=tick,
                x_ticks=1,
                height=140,
            ),
        ],
        (x, 0, _END),
        {
            n: Control(
                low=0.5, high=_OFTEN, step=_SWINGS, start=start, name="swings during the move"
            ),
            zeta: Control(
                low=_LIGHTEST, high=0.3, step=0.005, start=damping_ratio, name="damping ratio"
            ),
        },
        says=[
            _peaks(_chosen(c_a, known), c_a, of_mass),
            Say(
                "after the move its swing has |A| up to {left:.3g}, and is up to {share:.3g} "
                "percent of the stroke",
                {"left": left, "share": 100 * share},
            ),
        ],
        pin="Keep this one, dashed",
        title="A mass on a spring, and what is left after its move",
    )


def _chosen(c_a: sp.Expr, known: Sequence[MotionLaw]) -> Any:
    """Return the symbol of the choice that a factor hangs on; of one law alone its name."""
    return next(iter(c_a.free_symbols), known[0].name)


def _left_behind(curve: sp.Expr, *swings: sp.Expr) -> list[sp.Expr]:
    """Return the largest size that a deflection or an acceleration has at any time after the move.

    It has it when the move ends, or where it turns for the first time; later it is smaller. There
    is one for each number of `swings`, which stands for n: put into the result it takes seconds.
    """
    since = sp.Symbol("since", positive=True)
    free = curve.subs(x, 1 + since)  # no zone is left in it
    at_once, rate = (free.diff(since, order).subs(since, 0) for order in range(2))
    return [
        _largest_left(at_once.xreplace({n: each}), rate.xreplace({n: each}), each)
        for each in swings
    ]


def _largest_left(at_once: sp.Expr, rate: sp.Expr, swings: sp.Expr) -> sp.Expr:
    """Return the largest size of a free swing that begins with a value and a rate of change."""
    w, root = 2 * sp.pi * swings, sp.sqrt(1 - zeta**2)
    other = (rate + zeta * w * at_once) / (w * root)
    across = w * (zeta * other + root * at_once)
    turn = sp.atan2(rate**2, rate * across)  # the first angle from 0 on: half a turn goes on both
    turning = sp.sqrt(at_once**2 + other**2) * root * sp.exp(-zeta * turn / root)
    return sp.Max(sp.Abs(at_once, evaluate=False), turning, evaluate=False)


def _curves(law: MotionLaw, mass: OneMass) -> tuple[Any, ...]:
    """Return S and A of the cam, deflection and acceleration of the mass, and Ca."""
    s = sp.Piecewise((law.s, x <= 1), (1, True), evaluate=False)
    return s, _acceleration(law), mass.z, mass.a, law.Ca


def _acceleration(law: MotionLaw) -> sp.Expr:
    """Return A of the cam, which stands after the move."""
    return sp.Piecewise((law.a, x <= 1), (0, True), evaluate=False)


def _picture(s: sp.Expr, z: sp.Expr) -> Panel:
    """Return the cam's end of the spring, the spring, and the mass, where the clock stands."""
    length = _SPRING + _SHOWN * z
    middle = s + length + _HALF_MASS
    side = 2 * sp.Abs(x - 2) - 2  # runs round a square, cut at -1 and 1, while x goes from 0 to 4
    other = 2 * sp.Abs(sp.Mod(x + 1, 4) - 2) - 2
    corners = [sp.Rational(odd, 2) for odd in (1, 3, 5, 7)]
    square = [sp.Max(-1, sp.Min(1, each, evaluate=False), evaluate=False) for each in (side, other)]
    coil = sp.sin(2 * sp.pi * _COILS * x) / 4
    return Panel(
        lines=[
            Line(x=s - (1 - x) * (s + 1), y=0, over=(0, 1), role=FRAME),
            Line(x=s, y=x, over=(-0.7, 0.7), role=FRAME),
            Line(x=s + x * length, y=coil, over=(0, 1), role=FRAME),
            Line(
                x=middle + _HALF_MASS * square[0],
                y=0.8 * square[1],
                over=(0, 4),
                joints=corners,
                colour=_MASS,
            ),
        ],
        points=[
            Point(x=s, y=0, name="cam", colour=_CAM),
            Point(x=middle, y=0, name="mass", colour=_MASS),
        ],
        x_limits=(-0.4, 2.6),
        y_limits=(-1, 1),
        x="",
        is_bare=True,
        height=90,
        title="The cam moves one end of the spring; the mass is at the other",
    )


def _tops(law: MotionLaw, often: float, damping_ratio: float) -> tuple[float, float]:
    """Return where axes end that hold |A| of cam and mass at up to so many swings, all and left."""
    swings = np.arange(float(_RARE), often + _SWINGS / 2, _SWINGS)
    left = residual_vibration(law, swings, damping_ratio) * (2 * np.pi * swings) ** 2
    during = law.Ca * dynamic_factor(law, swings, damping_ratio)
    after = float(np.max(left))
    of_all = max(law.Ca, float(np.max(during)), after)
    return _end(of_all, _MOST, _TICK), _end(after, _SOFT, _SOFT_TICK)


def _end(largest: float, usual: float, tick: float) -> float:
    return max(usual, tick * math.ceil(largest / _OVER / tick))


def _axis(chosen: Any, ends: Sequence[float], usual: float, tick: float) -> tuple[Any, Any]:
    """Return where an axis ends, as is usual unless a law needs more, and the step of its ticks."""
    most = max(ends)
    return (chosen if most > usual else usual), (tick if most <= usual + tick else None)


def _over_time(a: sp.Expr, of_mass: sp.Expr, axis: tuple[Any, Any], height: float) -> Panel:
    """Return the accelerations of cam and mass over the time, on an axis to an end with ticks."""
    top, tick = axis
    return Panel(
        lines=[
            Line(y=a, name="cam", colour=_CAM),
            Line(y=of_mass, name="mass", colour=_MASS, over=(0, 1)),  # two lines: twice as fine
            Line(y=of_mass, colour=_MASS, over=(1, _END)),
        ],
        y="acceleration A",
        x="time x = t/tm",
        x_ticks=0.25,
        y_limits=(-top, top),
        y_ticks=tick,
        height=height,
    )


def _sentences(law: Any, c_a: Any, of_mass: sp.Expr) -> Iterator[Say]:
    yield _peaks(law, c_a, of_mass)
    yield Say(
        "after the move the mass swings with |A| up to {after:.3g}", {"after": _after(of_mass)}
    )
    yield Say("(deflection of the spring drawn {shown:.3g} times as large)", {"shown": _SHOWN})


def _peaks(law: Any, c_a: Any, of_mass: sp.Expr) -> Say:
    size = sp.Abs(of_mass, evaluate=False)
    peak = sp.Max(largest(size, (x, 0, 1)), _after(of_mass), evaluate=False)
    return Say(
        "{law}: largest |A| of the cam {cam:.3g}, of the mass {peak:.3g}, "
        "which is {times:.3g} times as much",
        {"law": law, "cam": c_a, "peak": peak, "times": peak / c_a},
    )


def _after(of_mass: sp.Expr) -> sp.Expr:
    """Return the largest acceleration after the move; later it only dies away."""
    return largest(sp.Abs(of_mass, evaluate=False), (x, 1, 1 + 1 / n))
