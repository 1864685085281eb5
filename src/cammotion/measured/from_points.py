"""A motion law from a table of points, as a cam is measured or an old drawing lists it."""

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from cammotion.arguments import checked, warn
from cammotion.measured.cam_table import CamTable
from cammotion.measured.fits import Fit, Monotone, Periodic, Through
from cammotion.measured.sampled_law import SampledLaw
from cammotion.measured.smoother import AnyPoints, chosen_amount
from cammotion.measured.smoothing import AMOUNT
from cammotion.quantities import Floats, InputError, Quantity, one_of, shorten

_PLACE = Quantity("x of the points", "", example=0.5, high=1.0, low_included=True)
_WAY = Quantity("s of the points", "", example=0.5, low=-1.0, high=2.0, low_included=True)
_FARTHEST = 1.5  # strokes from the middle: s from -1 to 2
_SLOPE = Quantity("velocity V at an end", "", example=0, low=-100.0, high=100.0, low_included=True)
_STEP = Quantity("step of the points", "", example=0.001, high=1.0, low_included=True)
FEWEST = 4  # points
NARROW = 1e-6  # between two points, at least
_ROUNDING = 1e-12  # by so much the ends may miss 0 and 1
_DIGITS = 9  # points with more are taken for exact
_TABLE = 12  # fewer points are taken for chosen by hand
_LAST_BIT = 1e-15
_CUBIC = 4  # the order of differences in which a cubic is 0
_STEEPEST = 3.0  # times the line between two points: a steeper cubic may turn between them
MUCH = 0.2  # of the peak: an effect of the rounding that is to be warned of

Kind = Literal["through", "smooth", "monotone", "periodic"]


def law_from_points(  # noqa: PLR0913 - all but the points are given by name
    x: ArrayLike,
    s: ArrayLike,
    *,
    name: str = "sampled law",
    end_slopes: tuple[float, float] = (0, 0),
    fit: Kind = "through",
    smoothing: float | None = None,
    step: float | None = None,
    rounded_ends: bool = False,
) -> SampledLaw:
    """Return a law from points, in polynomials of the third degree, one between any two points.

    `x` and `s` are arrays of the same length, at least 4, both dimensionless and from 0 at the
    first point to 1 at the last; `x` rises from point to point. `end_slopes` are the velocities V
    at both ends, dimensionless. `fit` is one of

    - "through": the cubic spline through all points;
    - "smooth": the smoothing spline between the two end points, at most 1000 points;
    - "periodic": a law that is repeated without rest, as of a wheel that never stops: it ends with
      the velocity and the acceleration with which it begins, and has no `end_slopes`;
    - "monotone": PCHIP, which never swings over its points: between two that rise it rises.
      Its acceleration jumps at every point, so that Cj is infinite. Its `end_slopes` are from 0
      to 3 times the slope of the line to the neighbouring point; steeper ones would swing over.

    `smoothing` is the amount for "smooth" and "periodic", what `smoothed` calls so, with the places
    in x: a wave of n swings from 0 to 1 is divided by 1 + smoothing (2 pi n)^4. None lets
    generalised cross-validation choose it for "smooth", and is 0 for "periodic".

    `step` is the step to which s is rounded. None takes it from the digits of s; where they are
    more than 9, or the points fewer than 12, s is taken for exact. So give it where s was divided
    by a stroke. With `rounded_ends` that stroke is the difference of two rounded positions, of a
    table say, whose own rounding shifts and scales all the others; without, 0 and 1 are exact. What
    the rounding does to the acceleration is `law.rounding`; where that may be more than a fifth of
    Ca, a UserWarning says so.

    S and V are continuous inside, and A, but with "monotone". Where A is not 0 at an end it jumps
    there, from or to the rest: then Cj is infinite, and `jerk_impulses` lists it. A spline through
    coarse points may swing over them, even below 0 or above 1; the law is then as good as any other
    that turns back: its `is_monotone` is False, and `where_above` takes the place of `inverse`.
    Raises InputError for points that are no table of a law.

    >>> places = np.linspace(0, 1, 19)
    >>> law = law_from_points(places, places**2 * (3 - 2 * places), name="follower")
    >>> law
    MotionLaw('follower', sampled at 19 points)
    >>> print(f"{law(0.3):.3f} {law.Ca:.3f}")
    0.216 6.000

    Fifty millimetres of a cycloid in 361 points, printed to a hundredth of a mm:

    >>> places = np.linspace(0, 1, 361)
    >>> cycloid = places - np.sin(2 * np.pi * places) / (2 * np.pi)
    >>> law_from_points(places, (50 * cycloid).round(2) / 50, fit="smooth", name="cycloid")
    MotionLaw('cycloid', sampled at 361 points rounded to 0.0002: Ca within 0.57)
    """
    places, ways = _checked(x, s)
    slopes = _SLOPE.array(end_slopes)
    if slopes.shape != (2,):
        raise InputError("The end_slopes have to be two numbers: give for example (0, 0).")
    kind = one_of("fit", fit, ("through", "smooth", "monotone", "periodic"))
    if smoothing is not None and kind in ("through", "monotone"):
        raise InputError(
            f"The smoothing is {shorten(smoothing)}, and a fit {kind!r} has none: give "
            "fit='smooth', or fit='periodic'."
        )
    if kind == "periodic" and slopes.any():
        raise InputError(
            f"The end_slopes are {shorten(end_slopes)}, and a fit 'periodic' has none: leave them "
            "out, or give fit='smooth'."
        )
    amount = None if smoothing is None else AMOUNT.number(smoothing)
    found = _fitted(kind, places, ways, (float(slopes[0]), float(slopes[1])), amount)
    told = step_of(ways) if ways.size >= _TABLE else 0.0
    grain = told if step is None else _STEP.number(step)
    law = SampledLaw(name, places, ways, found, grain, rounded_ends=bool(rounded_ends))
    _warn(law)
    return law


@checked
def law_from_table(
    table: CamTable,
    *,
    name: str = "sampled law",
    end_slopes: tuple[float, float] = (0, 0),
    fit: Kind = "through",
    smoothing: float | None = None,
) -> SampledLaw:
    """Return the law of a table that is one rise or one return, and knows its own rounding.

    All its positions are rounded to its `step_mm`, those at both ends, too. The other arguments are
    those of `law_from_points`. Raises InputError for a cycle, and for a table that ends where it
    begins, or goes beyond its ends by more than what lies between them.

    >>> angles = np.arange(0, 61.0)
    >>> rise = CamTable(angles, 25 - 25 * np.cos(np.radians(3 * angles)))
    >>> print(f"{law_from_table(rise).Ca:.2f}")
    4.94
    """
    angles, positions = table.angle_deg, table.position_mm
    stroke = float(positions[-1] - positions[0])
    farthest = np.abs(positions - (positions[0] + positions[-1]) / 2).max()
    is_beyond = bool(stroke) and farthest > _FARTHEST * abs(stroke)
    if table.is_cycle or is_beyond or abs(stroke) <= table.step_mm:
        by_way = f" by way of {positions.min():g} and {positions.max():g} mm" if is_beyond else ""
        raise InputError(
            f"The table goes from {positions[0]:g} to {positions[-1]:g} mm{by_way}"
            f"{' and is a cycle' if table.is_cycle else ''}; a law is one rise or one return: give "
            "the part of the table between two rests."
        )
    x = (angles - angles[0]) / (angles[-1] - angles[0])
    return law_from_points(
        x,
        (positions - positions[0]) / stroke,
        name=name,
        end_slopes=end_slopes,
        fit=fit,
        smoothing=smoothing,
        step=table.step_mm / abs(stroke),
        rounded_ends=True,
    )


def step_of(values: ArrayLike) -> float:
    """Return the step of which all values are multiples, as their decimal digits tell; 0 for none.

    Values with more than 9 digits have none, and neither have those whose fourth differences are
    0: they are the exact values of a cubic, whereas rounding leaves a mark in every difference.

    >>> step_of([0, 0.25, 0.4, 0.5, 0.8, 1]), step_of([0, 1 / 3, 1])
    (0.05, 0.0)
    """
    numbers = np.asarray(values, dtype=float)
    near = _LAST_BIT * np.maximum(1, np.abs(numbers))
    if np.any(np.abs(numbers - np.round(numbers, _DIGITS)) > near):
        return 0.0
    counts = np.round(numbers * 10**_DIGITS).astype(np.int64)
    is_cubic = not np.any(np.diff(counts, _CUBIC))
    return 0.0 if is_cubic else float(np.gcd.reduce(counts)) / 10**_DIGITS


def _fitted(
    kind: str, places: Floats, ways: Floats, slopes: tuple[float, float], amount: float | None
) -> Fit:
    """Return the fit of a kind; an amount of smoothing that is None is chosen."""
    match kind:
        case "through":
            return Through(places, slopes)
        case "smooth":
            smoother = AnyPoints(places, "clamped", slopes=slopes)
            if amount is None:
                amount = chosen_amount(smoother, smoother.modes(ways))
            return Through(places, slopes, smoother, amount)
        case "monotone":
            _check_steepness(places, ways, slopes)
            return Monotone(places, slopes)
    return Periodic(places, amount or 0.0)


def _check_steepness(places: Floats, ways: Floats, slopes: tuple[float, float]) -> None:
    """Raise InputError for slopes with which a cubic at an end swings over its points."""
    lines = np.diff(ways) / np.diff(places)
    for which, slope, line in zip(("first", "last"), slopes, lines[[0, -1]], strict=True):
        low, high = sorted((0.0, _STEEPEST * float(line)))
        if not low <= slope <= high:
            raise InputError(
                f"The velocity V at the {which} point is {slope:g}, with which a fit 'monotone' "
                f"would swing over its points: give one from {low:g} to {high:g}, or fit='through'."
            )


def _warn(law: SampledLaw) -> None:
    """Say it where the rounding of the points may be much of what the law is."""
    if not law.step:
        return
    peak = law.curve.derived(2).largest
    if law.rounding.bound > MUCH * peak:
        better = "more smoothing" if law.fit.is_smooth else "a smoothing spline (fit='smooth')"
        warn(
            f"The points of the law {law.name!r} are rounded to {law.step:g}. That alone changes A "
            f"by {law.rounding.rms:.3g} (root mean square) and by up to {law.rounding.bound:.3g}, "
            f"where A is {peak:.3g} at most: take {better}, or points with more digits."
        )


def _checked(x: ArrayLike, s: ArrayLike) -> tuple[Floats, Floats]:
    """Return the points as two arrays, with exact ends."""
    places, ways = _PLACE.array(x).copy(), _WAY.array(s).copy()
    if places.ndim != 1 or places.shape != ways.shape or places.size < FEWEST:
        raise InputError(
            f"The points are an array of shape {places.shape} in x and {ways.shape} in s: give two "
            f"lists of the same length, with at least {FEWEST} numbers each."
        )
    for what, values in (("x", places), ("s", ways)):
        if abs(values[-1] - values[0]) <= _ROUNDING:
            raise InputError(
                f"The {what} of the points ends where it begins, at {values[0]:g}; a law is one "
                "rise or one return: give the points between two rests."
            )
        if max(abs(values[0]), abs(values[-1] - 1)) > _ROUNDING:
            raise InputError(
                f"The {what} of the points goes from {values[0]:.10g} to {values[-1]:.10g}; a "
                f"motion law goes from 0 to 1: subtract the first {what}, and divide by the last "
                "less the first."
            )
        values[[0, -1]] = 0, 1
    steps = np.diff(places)
    if np.min(steps) < NARROW:
        n = int(np.argmax(steps < NARROW))
        raise InputError(
            f"The x of the points is {places[n + 1]:g} (at position {n + 1}) after {places[n]:g}; "
            f"it has to rise by at least {NARROW:g} from point to point: sort the points by x, "
            "and give each x once."
        )
    return places, ways
