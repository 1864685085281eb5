"""Where a curve has to be drawn beside even places, so that its peaks are met."""

from contextlib import suppress
from itertools import pairwise

import numpy as np

from cammotion.laws.curve import Curve
from cammotion.quantities import Floats, InputError

_NEAR = 1e-9  # of a curve: so far from a joint is at its side
_SHORT = 0.06  # of the time: a longer piece has a dozen of 200 even places
_MANY = 20  # short pieces are those of a table, which even places meet together


def corners(curve: Curve) -> Floats:
    """Return where a curve ends and turns, and both sides of each joint, where it may jump.

    Where it turns so often that its turns are not proved, these are left out.

    >>> from cammotion.laws.catalogue import as_law
    >>> corners(as_law("cycloidal").curve.derived(2))
    array([0.  , 0.25, 0.75, 1.  ])
    """
    near = _NEAR * (curve.high - curve.low)
    joints = [before.high for before, _ in pairwise(curve.pieces)]
    ends = [curve.low, curve.high, *joints, *(at + side for at in joints for side in (-near, near))]
    turns: list[float] = []
    with suppress(InputError):
        turns = [branch.low for branch in curve.branches]
    return np.union1d(ends, turns)


def within_short_pieces(curve: Curve, count: int) -> Floats:
    """Return so many places of each piece of a law in which even places are few, as of a ramp.

    None of a law of many pieces, which is from points, and bent little in each.

    >>> from cammotion.laws.catalogue import as_law
    >>> within_short_pieces(as_law("cubic").with_constant_velocity(0.96).curve, 3)
    array([0.  , 0.01, 0.02, 0.98, 0.99, 1.  ])
    """
    ends = [(piece.low, piece.high) for piece in curve.pieces]
    short = [np.linspace(*span, count) for span in ends if span[1] - span[0] < _SHORT]
    return np.concatenate([np.empty(0), *(short if len(short) < _MANY else [])])
