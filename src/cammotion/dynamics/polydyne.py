"""A cam designed backwards: from the motion that the mass is to make to the lift that makes it.

The mass is that of `OneMass`: on a spring whose other end the cam moves, with a damper beside it,

    Y'' + 2 D w (Y' - S') + w^2 (Y - S) = 0,    w = 2 pi tau,

where S is the cam, Y the mass, both as parts of the stroke over x = t/tm. Let Q be a law. Then

    S = Q + 2 D/w Q' + Q''/w^2    and    Y = Q + 2 D/w Q'

are a cam and the motion that it gives, as one sees by putting them in. Undamped the mass makes the
law itself; with a damper it is ahead of it, by 2 D/w of the time. (With the damper between mass and
frame instead, the same S gives Q itself.)

The cam's own acceleration is made of the law's first four derivatives. Where the third jumps, also
from the rest before the move, the cam's velocity would jump; so the law has to be as smooth as the
4-5-6-7 polynomial.
"""

from dataclasses import dataclass
from typing import Any

import sympy

from cammotion.dynamics.chain import UNDERDAMPED
from cammotion.dynamics.one_mass import SWINGS, OneMass
from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import JUMP, MotionLaw
from cammotion.laws.symbols import exact, x
from cammotion.quantities import InputError, Quantity, shorten

_JUMPING = {
    1: ("velocity", "have to be infinitely high"),
    2: ("acceleration", "have to jump itself"),
    3: ("jerk", "have to jump in its velocity"),
}
"""Of the derivatives of a law: what it is that jumps, and what the cam would."""


@dataclass(frozen=True)
class Polydyne:
    """A cam for a follower that gives way; made by `polydyne`.

    `law` is the one that was wanted, `cam` the lift of the cam and `mass` the motion of the mass,
    all three laws; `swings` and `damping_ratio` are those for which the cam is made.
    """

    law: MotionLaw
    cam: MotionLaw
    mass: MotionLaw
    swings: float
    damping_ratio: float

    def __repr__(self) -> str:
        numbers = f"swings={self.swings:g}, damping_ratio={self.damping_ratio:g}"
        return f"Polydyne({shorten(self.law.name)}, {numbers})"

    def at_rate(self, factor: float) -> OneMass:
        """Return what the mass does when the machine runs so many times as fast.

        Raises InputError for a factor that is not above 0.

        >>> wanted = polydyne("4-5-6-7 polynomial", swings=3)
        >>> for factor in (1, 1.1):
        ...     print(f"{wanted.at_rate(factor).peak:.2f}")
        7.51
        8.17
        """
        faster = Quantity("factor of the rate", "", example=1.1).number(factor)
        return OneMass(self.cam, self.swings / faster, self.damping_ratio)


def polydyne(law: str | MotionLaw, swings: float, damping_ratio: float = 0.0) -> Polydyne:
    """Return the cam whose mass moves by a law at one rate of the machine, without swinging on.

    `law` is a name or a law whose third derivative goes on without a jump, from rest to rest, as
    that of the 4-5-6-7 polynomial does. `swings` is the period ratio tm/Tn at that rate, from 1e-6
    to 1000; `damping_ratio` is from 0 to 0.99. The cam is a law, so that motions
    and cams can be made of it; it may go below 0 and above 1, and ends at both. Raises InputError
    for a law that is not so smooth, and for numbers out of range.

    >>> made = polydyne("4-5-6-7 polynomial", swings=2, damping_ratio=0.05)
    >>> print(f"{made.cam.Ca:.2f}, {made.mass.Ca:.2f}, {made.law.Ca:.2f}")
    5.32, 7.53, 7.51
    """
    wanted = as_law(law)
    numbers = SWINGS.number(swings), UNDERDAMPED.number(damping_ratio)
    _check(wanted)
    lead = 2 * exact(numbers[1]) / (2 * sympy.pi * exact(numbers[0]))
    give = 1 / (2 * sympy.pi * exact(numbers[0])) ** 2
    name = f"{wanted.name}, for {numbers[0]:.4g} swings"
    cam = _made(f"cam of {name}", wanted, (1, lead, give))
    return Polydyne(wanted, cam, _made(f"mass by {name}", wanted, (1, lead, 0)), *numbers)


def _made(name: str, law: MotionLaw, weights: tuple[Any, ...]) -> MotionLaw:
    """Return the weighted sum of a law and its derivatives, zone by zone."""
    cases = [
        (sum(w * sympy.diff(p.expression, x, n) for n, w in enumerate(weights)), x <= exact(p.high))
        for p in law.curve.pieces
    ]
    if len(cases) == 1:
        return MotionLaw(name, cases[0][0])
    return MotionLaw(name, sympy.Piecewise(*cases[:-1], (cases[-1][0], True), evaluate=False))


def _check(law: MotionLaw) -> None:
    law.check_way()
    for order, (what, would) in _JUMPING.items():
        curve = law.curve.derived(order)
        steps = ((0.0, curve.ends[0]), *curve.steps, (1.0, -curve.ends[1]))
        for at, by in steps:
            if abs(by) > JUMP * curve.largest:
                raise InputError(
                    f"The {what} of the law {law.name!r} jumps at x = {at:g}, and a cam that is "
                    f"designed backwards from it would {would} there: give a law as smooth as the "
                    "'4-5-6-7 polynomial'."
                )
