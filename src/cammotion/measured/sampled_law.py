"""A law from points: a motion law that knows its points, and what their rounding does to it."""

from functools import cached_property
from typing import NamedTuple

import numpy as np
import sympy

from cammotion.laws.motion_law import MotionLaw
from cammotion.measured.fits import Fit
from cammotion.quantities import Floats


class Rounding(NamedTuple):
    """What the rounding of the points to a `step` does to A, dimensionless: the largest of it.

    `rms` is the root mean square, as each point is off by anything up to half a step; `bound` is
    the most there can be, all points off by half a step with the worst signs (with the monotone
    fit, that has no such formula, the most of 64 to 1024 draws).
    """

    step: float
    rms: float
    bound: float


class SampledLaw(MotionLaw):
    """A law from points. `law_from_points` makes it.

    `sampled_at` are the places of the points in x and `ways` their S, `step` the step to which S is
    rounded, 0 for exact ones, and `amount` how much they were smoothed. With `rounded_ends` the
    positions at both ends are rounded, too. Reversed, or with a share of constant velocity, it is a
    law like any other and no longer one of points.
    """

    sampled_at: tuple[float, ...]
    ways: tuple[float, ...]
    step: float
    rounded_ends: bool
    fit: Fit

    def __init__(  # noqa: PLR0913 - all that is known of the points
        self,
        name: str,
        places: Floats,
        ways: Floats,
        fit: Fit,
        step: float,
        *,
        rounded_ends: bool = False,
    ) -> None:
        super().__init__(name, fit.curve(ways))
        points = {"sampled_at": tuple(places.tolist()), "ways": tuple(ways.tolist())}
        self.__dict__.update(points | {"fit": fit, "step": step, "rounded_ends": rounded_ends})

    @property
    def amount(self) -> float:
        """The amount of smoothing; 0 for the law through its points."""
        return self.fit.amount

    @cached_property
    def rounding(self) -> Rounding:
        """What the rounding of the points does to the acceleration A.

        Amid many even points, h apart, rounded to a step and not smoothed, it is 6 step/h^2 at
        most, and its root mean square sqrt(3) step/h^2; beside the ends both are others.
        """
        if not self.step:
            return Rounding(0.0, 0.0, 0.0)
        bound, rms = self.fit.effects(np.array(self.ways), self.step / 2, self.rounded_ends)
        return Rounding(self.step, float(rms.max()), float(bound.max()))

    def __repr__(self) -> str:
        points = f"sampled at {len(self.sampled_at)} points"
        if self.step:
            points += f" rounded to {self.step:g}: Ca within {self.rounding.bound:.2g}"
        return f"MotionLaw({self.name!r}, {points})"

    @property
    def _middle_velocity(self) -> sympy.Expr:
        return sympy.Float(self(0.5, 1))
