"""The explorer of the SCCA family: every law of it is a point of a triangle."""

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any

import numpy as np
import sympy as sp

from cammotion.laws.catalogue import LAWS
from cammotion.laws.scca_family import (
    LEAST_CA,
    NAMED_PARTS,
    scca_factor,
    zone_expression,
)
from cammotion.laws.symbols import x
from cammotion.views.live.explore import explore
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.formulas import largest
from cammotion.views.live.parts import FRAME, REFERENCE, Button, Control, Line, Panel, Point, Say

b, c = sp.symbols("b c", nonnegative=True)
_d = 1 - b - c
_START = "cycloidal"
_LEVELS = (4.2, 4.5, 5, 5.5, 6, 7, 8)
_MOST_J = 80
_NOTHING = 1e-9  # a part below it is rounding
_NAME_PLACES = ((0.31, 0.01), (0, -0.09), (0.02, 0.1), (0, 0.1), (0, -0.06))  # beside their points


def explore_scca() -> LiveFigure:
    """Return a live figure of the SCCA family: sine, constant and cosine part of the acceleration.

    Every law of the family is a point of a triangle, which can be dragged, and some of them have
    names. The controls are the sine part b and the constant part c, dimensionless, of which
    `figure.values` holds the present ones; the cosine part d is what is left of 1.

    >>> figure = explore_scca()
    >>> figure.press("modified trapezoid")
    >>> print(figure.text.splitlines()[0])
    b = 0.25, c = 0.5, d = 0.25: modified trapezoid, also called modified trapezoidal
    """
    s, v, a, j = _family(_d)
    start_b, start_c, _ = NAMED_PARTS[_START]
    return explore(
        [[_triangle()], list(_curves(s, v, a, j))],
        x,
        {
            b: Control(low=0, high=1, step=0.01, start=start_b, name="sine part b", most=1 - c),
            c: Control(low=0, high=1, step=0.01, start=start_c, name="constant part c", most=1 - b),
        },
        says=list(_sentences(v, a)),
        buttons=[
            Button(name, {b: sp.Float(parts[0]), c: sp.Float(parts[1])})
            for name, parts in NAMED_PARTS.items()
        ],
        shares=(1.4, 1),
        title="The SCCA family",
    )


def _family(d: sp.Expr) -> tuple[sp.Expr, ...]:
    """Return S, V, A and J over x for every b, c and d; an empty zone is never asked for."""
    ends = b / 2, (b + c) / 2, sp.Rational(1, 2)
    zones = [zone_expression(number, (b, c, d)) for number in range(len(ends))]
    curves = []
    for order in range(4):
        half = [sp.diff(zone, x, order) for zone in zones]
        sign = -1 if order % 2 == 0 else 1
        other = [int(order == 0) + sign * piece.xreplace({x: 1 - x}) for piece in half]
        pieces = [(piece, x < end) for piece, end in zip(half, ends, strict=True)]
        falls = (x <= 1 - ends[1]) & (d > 0)  # without a third zone the second goes to the middle
        later = [(other[2], falls), (other[1], x <= 1 - ends[0])]
        curves.append(sp.Piecewise(*pieces, *later, (other[0], True), evaluate=False))
    return tuple(curves)


def _curves(s: sp.Expr, v: sp.Expr, a: sp.Expr, j: sp.Expr) -> Iterator[Panel]:
    outside = sp.Piecewise((0, (x < 0) | (x > 1)), (a, True), evaluate=False)
    joints = [0, b / 2, (b + c) / 2, (1 + _d) / 2, 1 - b / 2, 1]
    jumps = [(0, 1, b), (sp.Rational(1, 2), -1, _d), (1, 1, b)]
    impulses = [
        Line(y=sign * x, x=place, over=(0, _MOST_J), only_where=_NOTHING - part, role=REFERENCE)
        for place, sign, part in jumps
    ]
    curves = {
        "S": ([Line(y=s)], (-0.06, 1.06), 0.5),
        "V": ([Line(y=v)], (-0.15, 3.15), 1),
        "A": ([Line(y=outside, over=(-0.03, 1.03), joints=joints)], (-9, 9), 4),
        "J": ([Line(y=j, joints=joints), *impulses], (-1.1 * _MOST_J, 1.1 * _MOST_J), _MOST_J / 2),
    }
    for letter, (lines, limits, ticks) in curves.items():
        yield Panel(
            lines=lines,
            y=letter,
            y_limits=limits,
            y_ticks=ticks,
            x_limits=(-0.03, 1.03),
            x_ticks=0.25,
            height=88,
        )


def _triangle() -> Panel:
    """Return the triangle of all b, c and d, the named laws in it, and lines of one Ca."""
    corners = [_place(1, 0), _place(0, 1), _place(0, 0), _place(1, 0)]
    sides = [
        Line(x=p[0] + x * (q[0] - p[0]), y=p[1] + x * (q[1] - p[1]), role=FRAME, over=(0, 1))
        for p, q in pairwise(corners)
    ]
    named = [
        Point(x=at[0], y=at[1], colour=5)
        for parts in NAMED_PARTS.values()
        for at in [_place(*parts[:2])]
    ]
    words = [("b = 1: sine", 0, -0.06), ("d = 1: cosine", 1, -0.2), ("c = 1: constant", 0.5, 0.94)]
    for (name, parts), (across, up) in zip(NAMED_PARTS.items(), _NAME_PLACES, strict=True):
        at = _place(*parts[:2])
        shown = name if name == "constant acceleration" else name.replace(" ", "\n")
        words.append((shown, float(at[0] + across), float(at[1] + up)))
    words += [*_level_words(), ("dashed lines:\nequal Ca", 0, 0.62)]
    own = _place(b, c)
    return Panel(
        lines=[*map(_level, _LEVELS), *sides],
        points=[*named, Point(x=own[0], y=own[1], drags=(b, c))],
        words=words,
        x_limits=(-0.14, 1.14),
        y_limits=(-0.29, 1.1),
        is_equal=True,
        is_bare=True,
        height=400,
        title="The triangle of all laws of the family; thin lines join laws of one Ca",
    )


def _level(factor: float) -> Line:
    """Return the line on which Ca is this, over b."""
    d = sp.Symbol("d", nonnegative=True)
    rest = sp.Poly(1 / scca_factor(x, d) - 1 / sp.Float(factor), d)  # has no term in d alone
    of_d = sp.sqrt(-rest.coeff_monomial(1) / rest.coeff_monomial(d**2))
    across, up = _place(x, 1 - x - of_d)
    inside = sp.Min(of_d, 1 - x - of_d, evaluate=False) + _NOTHING
    return Line(x=across, y=up, over=(0, 1), only_where=inside, role=REFERENCE)


def _level_words() -> Iterator[tuple[str, float, float]]:
    """Return where the lines of one Ca are labelled: where c is to d as 3 to 7."""
    of_b = np.linspace(0, 1, 201)
    factors = scca_factor(of_b, 0.7 * (1 - of_b), np.pi)
    for level in _LEVELS[1:]:
        at = np.interp(level, factors, of_b)
        across, up = _place(at, 0.3 * (1 - at))
        yield f"{level:g}", float(across), float(up)


def _place(b: Any, c: Any) -> tuple[sp.Expr, sp.Expr]:
    """Return the place in the triangle, b = 1 at its left, c = 1 at its top, d = 1 at its right."""
    height = sp.sqrt(3) / 2
    return sp.sympify(1 - b - c / sp.Integer(2)), sp.sympify(c * height)


def _sentences(v: sp.Expr, a: sp.Expr) -> Iterator[Say]:
    parts = {"b": b, "c": c, "d": _d}
    first = "b = {b:.4g}, c = {c:.4g}, d = {d:.4g}"
    said = Say(first, parts)
    for name, (of_b, of_c, _) in NAMED_PARTS.items():
        others = " or ".join(LAWS[name].also_called)
        is_here = (sp.Abs(b - of_b) < _NOTHING) & (sp.Abs(c - of_c) < _NOTHING)
        said = Say(f"{first}: {name}, also called {others}", parts, is_here, said)
    yield said
    yield _factors(v, a)
    factor = scca_factor(b, _d)
    yield Say(
        "Ca is {times:.4g} times the least that is possible, {least:g}",
        {"times": factor / LEAST_CA, "least": LEAST_CA},
        factor > LEAST_CA * (1 + _NOTHING),
        Say("Ca is the least that is possible, {least:g}", {"least": LEAST_CA}),
    )


def _factors(v: sp.Expr, a: sp.Expr) -> Say:
    factor = scca_factor(b, _d)
    turn = (x, 0, 1)
    numbers = {
        "v": v.xreplace({x: sp.Rational(1, 2)}),
        "a": factor,
        "j": sp.pi
        * factor
        / sp.Min(*(sp.Piecewise((p, p > _NOTHING), (1, True)) for p in (b, _d))),
        "q": largest(sp.Abs(v * a, evaluate=False), turn),
    }
    text = "Cv = {v:.4g}, Ca = {a:.4g}, Cj {jerk}, Cq = {q:.4g}"
    ends, middle = b < _NOTHING, _d < _NOTHING
    jumps: Mapping[str, Any] = {
        "at the ends and in the middle": ends & middle,
        "at the ends": ends,
        "in the middle": middle,
    }
    said = Say(text.replace("{jerk}", "= {j:.4g}"), numbers)
    for where, condition in reversed([*jumps.items()]):
        words = f"infinite (A jumps {where})"
        said = Say(text.replace("{jerk}", words), numbers, condition, said)
    return said
