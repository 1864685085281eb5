"""Motion laws as text for a table, and text read as a law: what it is, not only its name.

The text is one of four. `S = 3*x**2 - 2*x**3` is the expression; `scca(0.25, 0.5, 0.25)` the
family and its parameters; `law_from_points([0, 0.3, ...], [0, 0.1, ...])` the points, and how the
law lies to them; `polynomials(([0, 0.5, 1], [0, 0.5], [0, 2], [2, -2]))` lists for each
piece its knots and, by rising power of x less the knot, the coefficients from each knot on, so that
the first list beside the knots holds the points.
"""

import ast
import math
import warnings
from collections.abc import Callable, Iterator, Sequence
from itertools import combinations
from typing import Any

import numpy as np

from cammotion.exchange.expression_text import expression_as_text, expression_from_text, parsed
from cammotion.laws.curve import Curve
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.piece import Piece, Placed
from cammotion.laws.reader import write
from cammotion.laws.scca_family import scca
from cammotion.laws.series import Series, about
from cammotion.laws.spline import Spline
from cammotion.laws.symbols import exact
from cammotion.measured.fits import Monotone, Periodic, Through
from cammotion.measured.from_points import law_from_points
from cammotion.measured.sampled_law import SampledLaw
from cammotion.quantities import Floats, InputError, shorten

_EXPRESSION = "S ="
_SAME_S, _SAME = 1e-13, 1e-11  # by so much S may differ, and V, A and J as a share of the largest
_ONE_PLACE = 1e-9  # joints that are nearer are one
_PLACES = np.array([1e-6, 0.017, 0.21, 0.382, 0.5, 0.645, 0.84, 0.978, 1 - 1e-6])  # in each piece
_FEW = 12  # pieces, of which an expression is read in a moment
_ZONES = 3  # of a law of the SCCA family
_MOST = 31  # coefficients of a polynomial
_SMOOTH, _STEP = 3, 1e-6  # S, V and A of a spline go on but for such a share
_NO_TEXT = (
    AttributeError,
    KeyError,
    TypeError,
    ValueError,
    SyntaxError,
    ArithmeticError,
    MemoryError,
    RecursionError,
)


def law_as_text(law: MotionLaw) -> str:
    """Return text that `law_from_text` reads as the same law.

    It is read back before it is returned: S is the same to 1e-13, and V, A and J to 1e-11 of the
    largest value. Raises InputError for a law that no text gives back.

    >>> import cammotion as cm
    >>> law_as_text(cm.MotionLaw("cubic", 3 * cm.x**2 - 2 * cm.x**3))
    'S = -2*x**3 + 3*x**2'
    >>> law_as_text(cm.scca(0.25, 0.5, 0.25))
    'scca(0.25, 0.5, 0.25)'
    """
    for text in _texts(law):
        try:
            if is_same_law(law_from_text(law.name, text), law):
                return text
        except InputError:  # a form that does not fit
            continue
    raise InputError(
        f"The law {shorten(law.name)} cannot be written into a table, since no text gives it back "
        "as it is: give a table of its points to law_from_points, and move by that law."
    )


def law_from_text(name: str, text: str) -> MotionLaw:
    """Return the law of this name that a text says; raise InputError for any other text.

    >>> law_from_text("cubic", "S = 3*x**2 - 2*x**3")(0.5)
    0.5
    """
    if text.startswith(_EXPRESSION):
        return MotionLaw(name, expression_from_text(text.removeprefix(_EXPRESSION)))
    try:
        call = parsed(text)
        given = [ast.literal_eval(argument) for argument in call.args]
        more = {word.arg: ast.literal_eval(word.value) for word in call.keywords}
        return _FORMS[call.func.id](name, *given, **more)
    except InputError:
        raise
    except _NO_TEXT:
        pass
    raise InputError(
        f"The law {shorten(text)} cannot be read: write it like 'S = 3*x**2 - 2*x**3', or like "
        "'scca(0.25, 0.5, 0.25)'."
    )


def is_same_law(one: MotionLaw, other: MotionLaw) -> bool:
    """Return whether two laws are the same curve, whatever their names are.

    >>> import cammotion as cm
    >>> is_same_law(cm.scca(0.5, 0, 0.5), cm.LAWS["cycloidal"])
    True
    """
    if one.curve is other.curve:
        return True
    cuts = np.unique([cut for law in (one, other) for p in law.curve.pieces for cut in _knots(p)])
    cuts = cuts[np.append(True, np.diff(cuts) > _ONE_PLACE)]
    places = (cuts[:-1, None] + np.diff(cuts)[:, None] * _PLACES).ravel()
    for order in range(4):
        mine, theirs = (law.curve.derived(order)(places) for law in (one, other))
        allowed = _SAME * max(1.0, np.max(np.abs(theirs))) if order else _SAME_S
        if not np.max(np.abs(mine - theirs)) <= allowed:
            return False
    return True


def _texts(law: MotionLaw) -> Iterator[str]:
    """Yield texts that may give a law back, the plainest first."""
    pieces = law.curve.pieces
    if isinstance(law, SampledLaw):
        yield _points(law)
    yield from _sccas(pieces)
    is_short = len(pieces) <= _FEW and not any(
        isinstance(_inmost(piece), Spline) for piece in pieces
    )
    if is_short:
        yield _expression(pieces)
    lists = [_polynomials(piece) for piece in pieces]
    if all(lists):
        yield f"polynomials({', '.join(map(str, lists))})"
    if not is_short:
        yield _expression(pieces)


def _points(law: SampledLaw) -> str:
    """Return how a law from points was made."""
    fit, kind = law.fit, "smooth" if law.fit.is_smooth else "through"
    if not isinstance(fit, Through):
        kind = "periodic" if isinstance(fit, Periodic) else "monotone"
    ends = fit.slopes if isinstance(fit, Through | Monotone) else ()
    slopes = f", end_slopes={tuple(map(float, ends))}" if ends else ""
    smoothing = f", smoothing={float(fit.amount)}" if fit.is_smooth else ""
    rounded = f", step={float(law.step)}" + ", rounded_ends=True" * law.rounded_ends
    points = f"{[*law.sampled_at]}, {[*law.ways]}"
    return f"law_from_points({points}{slopes}, fit={kind!r}{smoothing}{rounded})"


def _sccas(pieces: tuple[Piece, ...]) -> Iterator[str]:
    """Yield the laws of the family whose zones are as wide as these pieces."""
    half, rest = divmod(len(pieces), 2)
    widths = [float(exact(2 * (piece.high - piece.low))) for piece in pieces[:half]]
    if rest or half > _ZONES or not math.isclose(sum(widths), 1):
        return
    for places in combinations(range(_ZONES), half):
        parts = dict(zip(places, widths, strict=True))
        yield f"scca({', '.join(str(parts.get(n, 0)) for n in range(_ZONES))})"


def _expression(pieces: tuple[Piece, ...]) -> str:
    zones = write((piece.expression, piece.low, piece.high) for piece in pieces)
    return f"{_EXPRESSION} {expression_as_text(zones)}"


def _inmost(piece: Piece) -> Piece:
    while isinstance(piece, Placed):
        piece = piece.inner
    return piece


def _knots(piece: Piece) -> list[float]:
    """Return the ends of a piece, and the knots between them if it is a spline."""
    inmost, steps = _inmost(piece), piece
    if isinstance(piece, Spline):
        return [*map(float, piece.knots)]
    if not isinstance(inmost, Spline):
        return [piece.low, piece.high]
    for _ in inmost.rows[1:]:
        steps = steps.derivative  # in the end a step at each knot
    return [piece.low, *steps.turns, piece.high]


def _polynomials(piece: Piece) -> tuple[list[float], ...]:
    """Return the knots of a piece and the coefficients from each on; () if it has others."""
    inmost, knots = _inmost(piece), _knots(piece)
    if isinstance(piece, Spline):
        return (knots, *piece.rows[::-1].tolist())
    if isinstance(inmost, Series):
        count = 0 if inmost.waves else len(inmost.powers)
    else:
        count = len(inmost.rows) if isinstance(inmost, Spline) else 0
    ends, columns = np.array(knots), []
    middles, halves = (ends[:-1] + ends[1:]) / 2, np.diff(ends) / 2
    for order in range(count):  # not at the knots, where rounding decides which polynomial it is
        columns.append(piece.over(middles.copy()) / math.factorial(order))
        piece = piece.derivative
    moved: list[Any] = about(columns, -halves)  # type: ignore[arg-type]  # all at once
    return (knots, *(column.tolist() for column in moved)) if count else ()


def _read_scca(name: str, b: float, c: float, d: float) -> MotionLaw:
    return MotionLaw(name, scca(b, c, d).curve)


def _read_points(name: str, x: list[float], s: list[float], **more: Any) -> MotionLaw:
    with warnings.catch_warnings(action="ignore"):  # whoever made the law was told
        return law_from_points(x, s, name=name, **more)


def _read_polynomials(name: str, *lists: Sequence[Sequence[float]]) -> MotionLaw:
    pieces = [
        _read_piece(name, *(np.array(row, dtype=np.float64) for row in rows)) for rows in lists
    ]
    cuts = [0.0, *(piece.high for piece in pieces)]
    if [*(piece.low for piece in pieces), 1.0] != cuts:
        raise InputError(
            f"The polynomials of the law {shorten(name)} do not follow each other from 0 to 1: let "
            "each list of knots begin where the one before it ends."
        )
    return MotionLaw(name, Curve(pieces))


def _read_piece(name: str, knots: Floats, *rows: Floats) -> Piece:
    fits = all(row.shape == (knots.size - 1,) and np.isfinite(row).all() for row in rows)
    if knots.size < 2 or not (fits and 0 < len(rows) <= _MOST and np.all(np.diff(knots) > 0)):  # noqa: PLR2004 - a beginning and an end
        raise InputError(
            f"The polynomials of the law {shorten(name)} cannot be read: list knots that rise, and "
            "for each power as many numbers as there are parts between the knots."
        )
    if knots.size == 2:  # noqa: PLR2004 - a single polynomial
        low, high = map(float, knots)
        return Series(tuple(float(row[0]) for row in rows), (), low, high)
    spline = Spline(knots, np.array(rows[::-1]))
    _check_smooth(name, spline)
    return spline


def _check_smooth(name: str, spline: Spline) -> None:
    """Raise InputError unless S, V and A go on at each knot, as those of a spline do."""
    inner = spline.knots[1:-1]
    curve = spline
    for _ in range(_SMOOTH):
        ends = curve._inside(slice(None), np.diff(curve.knots))
        steps = np.abs(curve.rows[-1][1:] - ends[:-1])
        if np.any(steps > _STEP * max(1.0, *map(abs, curve.extremes))):
            at = float(inner[np.argmax(steps)])
            raise InputError(
                f"The law {shorten(name)} jumps at x = {at:g} inside of one list of knots: begin "
                "another list there."
            )
        curve = curve.derivative


_FORMS: dict[str, Callable[..., MotionLaw]] = {
    "scca": _read_scca,
    "law_from_points": _read_points,
    "polynomials": _read_polynomials,
}
