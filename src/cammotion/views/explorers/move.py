"""The explorer of one move: rate, angle, stroke and law, over a reference that stays."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import sympy as sp

from cammotion.arguments import checked
from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.symbols import x
from cammotion.machine.kinematics import MM_PER_M, STANDARD_GRAVITY, Move
from cammotion.views.corners import corners, within_short_pieces
from cammotion.views.explorers.moving import ALPHA, LARGEST, control, sized, tens
from cammotion.views.live.explore import explore
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.parts import Line, Panel, Say, choice, pinned
from cammotion.views.plots import CURVES

N, B_m, h_m = sp.symbols("N B_m h_m", positive=True)
_WIDEST_DEG = 220
_CLOSE = 9  # places of a short ramp
_RATES, _STROKES_MM = (500, 5000, 50), (5, 100, 1)  # low, high, step


@checked
def explore_move(reference: Move, *, laws: Iterable[str | MotionLaw] = ()) -> LiveFigure:
    """Return a live figure of rate, angle and stroke, drawn over the `reference` move.

    It shows displacement, velocity and acceleration over the cam angle, the peak acceleration and
    its ratio to the reference's. `figure.values` are N in pieces per hour, B_m in deg and h_m in
    mm, as the learner has set them. `laws`, names or laws, for example `cammotion.LAWS`, can be
    chosen instead of its own. Raises InputError for what is no Move, and for an unknown law.

    >>> figure = explore_move(Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000))
    >>> figure.values = {B_m: 110}
    >>> print(figure.text.splitlines()[-1])
    ratio of the peaks: 0.25 = 1 (rate, squared) × 0.25 (angle, squared) × 1 (stroke)
    """
    own = as_law(reference.law)
    known = {law.name: law for law in (own, *map(as_law, laws))}
    known[own.name] = own
    own_places = _ramps(known)
    of_laws = {
        name: (law.s, law.v, law.a, law.Ca, law.curve.derived(2).largest or 1.0, *own_places[name])
        for name, law in known.items()
    }
    s, v, a, c_a, top, *ramp = choice("motion law", of_laws)
    t_m = sp.Symbol("t_m")
    stroke = h_m / MM_PER_M
    at = {x: ALPHA / B_m}
    curves = h_m * s.xreplace(at), stroke / t_m * v.xreplace(at), stroke / t_m**2 * a.xreplace(at)
    per_time = stroke / t_m**2
    rates = sized(_RATES, tens(reference.rate_per_hour, *_RATES[:2]))
    strokes = sized(_STROKES_MM, tens(reference.stroke_mm, *_STROKES_MM[:2]))
    return explore(
        _panels(curves, reference, strokes[1], top * per_time, [B_m * place for place in ramp]),
        (ALPHA, 0, B_m),
        {
            N: control("rate N", rates, reference.rate_per_hour, "pieces/h"),
            B_m: control("angle Bm", (20, _WIDEST_DEG, 1), reference.angle_deg),
            h_m: control("stroke hm", strokes, reference.stroke_mm, "mm"),
        },
        says=_sentences(c_a * per_time, c_a, t_m, is_several=len(known) > 1),
        pin="Pin this design as the reference",
        title="One move, and what makes it hard",
    )


def _ramps(laws: Mapping[str, MotionLaw]) -> dict[str, list[float]]:
    """Return x at which each law is drawn within its short ramps, of all as many: 0 is none."""
    found = {}
    for name, law in laws.items():
        close = within_short_pieces(law.curve, _CLOSE)
        found[name] = [*close, *corners(law.curve.derived(2))] if close.size else []
    most = max(map(len, found.values()))
    return {name: places + [0.0] * (most - len(places)) for name, places in found.items()}


def _panels(
    curves: Iterable[sp.Expr],
    reference: Move,
    longest_mm: float,
    peak: sp.Expr,
    ramps: Sequence[sp.Expr],
) -> list[Panel]:
    """Return displacement, velocity and acceleration, on axes that the reference fits into.

    `longest_mm` is the longest stroke that the figure offers. With short `ramps` the axis of the
    acceleration ends beyond the `peak`, which would be taken for a pole of the curve.
    """
    widest = max(_WIDEST_DEG, reference.angle_deg)
    longest = max(longest_mm, reference.stroke_mm)
    low, high = as_law(reference.law).curve.extremes
    heights = {"displacement": (longest * min(low, 0), longest * max(high, 1))}
    if ramps:
        top = sp.Max(peak, pinned(peak), evaluate=False) * sp.Rational(11, 10)
        heights["acceleration"] = (-top, top)
    joints = {"acceleration": ramps}
    return [
        Panel(
            lines=[Line(y=y, over=(0, B_m), joints=joints.get(name, ()), name="your design")],
            y=CURVES[name],
            x="cam angle from the start of the move in deg",
            x_limits=(0, widest),
            x_ticks=20,
            y_limits=heights.get(name),
        )
        for name, y in zip(("displacement", "velocity", "acceleration"), curves, strict=True)
    ]


def _sentences(peak: sp.Expr, c_a: Any, t_m: sp.Symbol, *, is_several: bool) -> Iterator[Say]:
    """Say what the design and the reference have, and how their peaks compare."""
    design = Say(
        "{whose}: tm = {t_m:.4g} s, a_max = {peak:.4g} m/s² = {in_g:.3g} g",
        {"whose": "your design", "t_m": t_m, "peak": peak, "in_g": peak / STANDARD_GRAVITY},
    )
    before = {name: pinned(value) for name, value in design.numbers.items() if name != "whose"}
    yield design
    yield Say(design.text, before | {"whose": "reference"})
    yield Say(
        "ratio of the peaks: {ratio:.4g} = {rate:.4g} (rate, squared) × {angle:.4g} (angle, "
        "squared) × {stroke:.4g} (stroke)" + " × {law:.4g} (law)" * is_several,
        {
            "ratio": peak / pinned(peak),
            "rate": (N / pinned(N)) ** 2,
            "angle": (pinned(B_m) / B_m) ** 2,
            "stroke": h_m / pinned(h_m),
            "law": c_a / pinned(c_a),
        },
        when=(peak < LARGEST) & (pinned(peak) < LARGEST),
        otherwise=Say("ratio of the peaks: none, since the velocity of a law jumps"),
    )
