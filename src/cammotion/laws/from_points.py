"""A motion law from a table of points, as a cam is measured or an old drawing lists it."""

import numpy as np
from numpy.typing import ArrayLike

from cammotion.laws.curve import Curve
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.spline import Spline
from cammotion.quantities import Floats, InputError, Quantity

_PLACE = Quantity("x of the points", "", example=0.5, high=1.0, low_included=True)
_WAY = Quantity("s of the points", "", example=0.5, low=-1.0, high=2.0, low_included=True)
_SLOPE = Quantity("velocity V at an end", "", example=0, low=-100.0, high=100.0, low_included=True)
_FEWEST = 4
_STEP = 1e-6  # between two points, at least
_ROUNDING = 1e-12  # by so much the ends may miss 0 and 1


def law_from_points(
    x: ArrayLike,
    s: ArrayLike,
    *,
    name: str = "sampled law",
    end_slopes: tuple[float, float] = (0, 0),
) -> MotionLaw:
    """Return the law that goes through points: a cubic spline, one polynomial between any two.

    `x` and `s` are arrays of the same length, at least 4, both dimensionless and from 0 at the
    first point to 1 at the last; `x` rises from point to point. `end_slopes` are the velocities V
    at both ends, dimensionless.

    S, V and A are continuous inside. Where A is not 0 at an end it jumps there, from or to the
    rest: then Cj is infinite, and `jerk_impulses` lists it. A spline through coarse points may
    swing over them, even below 0 or above 1; the law is then as good as any other that turns back:
    its `is_monotone` is False, and `where_above` takes the place of `inverse`. Raises InputError
    for points that are no table of a law.

    >>> places = np.linspace(0, 1, 19)
    >>> law = law_from_points(places, places**2 * (3 - 2 * places), name="follower")
    >>> law
    MotionLaw('follower', sampled at 19 points)
    >>> print(f"{law(0.3):.3f} {law.Ca:.3f}")
    0.216 6.000
    """
    places, ways = _checked(x, s)
    slopes = _SLOPE.array(end_slopes)
    if slopes.shape != (2,):
        raise InputError("The end_slopes have to be two numbers: give for example (0, 0).")
    from scipy.interpolate import CubicSpline  # it takes a second to load

    spline = CubicSpline(places, ways, bc_type=[(1, slope) for slope in slopes])
    curve = Curve([Spline(places, spline.c)])
    return MotionLaw(name, curve, sampled_at=tuple(places.tolist()))


def _checked(x: ArrayLike, s: ArrayLike) -> tuple[Floats, Floats]:
    """Return the points as two arrays, with exact ends."""
    places, ways = _PLACE.array(x).copy(), _WAY.array(s).copy()
    if places.ndim != 1 or places.shape != ways.shape or places.size < _FEWEST:
        raise InputError(
            f"The points are an array of shape {places.shape} in x and {ways.shape} in s: give two "
            f"lists of the same length, with at least {_FEWEST} numbers each."
        )
    for what, values in (("x", places), ("s", ways)):
        if max(abs(values[0]), abs(values[-1] - 1)) > _ROUNDING:
            raise InputError(
                f"The {what} of the points goes from {values[0]:g} to {values[-1]:g}; a motion law "
                f"goes from 0 to 1: subtract the first {what}, and divide by the last less the "
                "first."
            )
        values[[0, -1]] = 0, 1
    steps = np.diff(places)
    if np.min(steps) < _STEP:
        n = int(np.argmax(steps < _STEP))
        raise InputError(
            f"The x of the points is {places[n + 1]:g} (at position {n + 1}) after {places[n]:g}; "
            f"it has to rise by at least {_STEP:g} from point to point: sort the points by x, and "
            "give each x once."
        )
    return places, ways
