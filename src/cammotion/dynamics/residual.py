"""What a law leaves behind in a mass on a spring, and what it makes of the push meanwhile.

Both are asked for many ratios tm/Tn at once, of a single move from rest and of a machine that has
run for long, where each move begins with what the moves before it have left.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from cammotion.arguments import checked
from cammotion.dynamics.chain import UNDERDAMPED
from cammotion.dynamics.forcing import check_velocity
from cammotion.dynamics.swing import Complexes, Swing, ways_for
from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.quantities import Floats, InputError, Numbers, Quantity, plain

RATIO = Quantity("period ratio tm/Tn", "", example=4, low=1e-6, high=1000, low_included=True)
_MOST = 5_000_000  # masses times ways at once, which take some hundred MB

Asked = Callable[[Swing, Complexes, int, int], Floats]
"""What is wanted of a swing: with v at its joints, and between which of them the move lies."""


def residual_vibration(
    law: str | MotionLaw, ratios: ArrayLike, damping_ratio: float = 0.0
) -> Numbers:
    """Return how far a mass swings after a single move, as a part of the stroke.

    `law` is a law or its name; `ratios` is tm/Tn, how often the mass swings during the move, 1e-6
    to 1000, a number or an array; the result has its shape. `damping_ratio` is from 0 to
    0.99. The mass rests before the move; what is returned is its largest distance from the cam at
    any time after the move. Undamped, times (2 pi tm/Tn)^2 it is the acceleration that stays, in
    hm/tm^2. Raises InputError for other numbers, and for a law whose velocity jumps or that does
    not go from 0 to 1.

    >>> print(f"{residual_vibration('cycloidal', 1):.6f}")  # |sin pi l|/(pi l |1 - l^2|)
    0.500000
    """
    return _single(law, ratios, damping_ratio, _left_behind)


def dynamic_factor(law: str | MotionLaw, ratios: ArrayLike, damping_ratio: float = 0.0) -> Numbers:
    """Return how many times the cam's peak acceleration that of the mass is, during the move.

    The arguments and errors are those of `residual_vibration`, the result has the shape of
    `ratios`. What comes after the move is not in it.

    >>> dynamic_factor("constant acceleration", [5, 10, 10.5]).round(2)
    array([4.  , 2.  , 3.24])
    """
    return _single(law, ratios, damping_ratio, Swing.largest) / as_law(law).Ca


@checked
def running_residual(motion: Motion, ratios: ArrayLike, damping_ratio: float = 0.02) -> Numbers:
    """Return how far the mass swings in the dwell after the first move of a running machine.

    It is a part of that move's stroke: the largest distance from the cam after the move, as if the
    dwell went on. `ratios` is tm/Tn of the move, 1e-6 to 1000; the result has its shape.
    The machine has run for long: what earlier moves have left is in it. `damping_ratio` is
    from 0 to 0.99. Raises InputError for other numbers, for a velocity that jumps, for no dwell
    after the first move, and where nothing damps the mass and it swings a whole number of times in
    a turn.

    >>> import cammotion as cm
    >>> once = residual_vibration("cycloidal", 2.5, 0.02)
    >>> print(f"once {once:.4f}, in a run {running_residual(cm.EXAMPLE.die, 2.5):.4f}")
    once 0.0203, in a run 0.0216
    """
    number = motion.segments.index(_first_move(motion))
    following = motion.segments[(number + 1) % len(motion.segments)]
    if not following.is_dwell:
        raise InputError(
            f"After its first move the motion {motion.name!r} goes on with a {following.kind}, so "
            "that nothing swings alone there: put a dwell between them."
        )
    return _running(motion, ratios, damping_ratio, _left_behind)


@checked
def running_factor(motion: Motion, ratios: ArrayLike, damping_ratio: float = 0.02) -> Numbers:
    """Return how many times the cam's peak acceleration the mass's is, in a running machine.

    Both are those during the first move of the turn. The arguments and errors are those of
    `running_residual`, but the move needs no dwell after it, and has to have an acceleration.

    >>> import cammotion as cm
    >>> print(f"{running_factor(cm.EXAMPLE.die, 5):.3f}")
    1.062
    """
    check_velocity(motion)
    move = _first_move(motion)
    cam = move.curve.derived(2).largest * move.angle_deg**2 / abs(move.change_mm)
    if not cam:
        raise InputError(
            f"In its first move the motion {motion.name!r} keeps its velocity, so that there is no "
            "peak to compare with: let it begin with another move."
        )
    return _running(motion, ratios, damping_ratio, Swing.largest) / cam


def _first_move(motion: Motion) -> Segment:
    if not motion.moves:
        raise InputError(
            f"The motion {motion.name!r} has no move, and so no mass swings: give one that has one."
        )
    return motion.moves[0]


def _left_behind(swing: Swing, v: Complexes, _: int, last: int) -> Floats:
    return swing.furthest(v[last])


def _single(law: str | MotionLaw, ratios: ArrayLike, damping_ratio: float, asked: Asked) -> Numbers:
    moves = as_law(law)
    check_velocity(moves)

    def answer(block: Floats) -> Floats:
        swing = Swing(moves.curve, block, UNDERDAMPED.number(damping_ratio))
        return asked(swing, swing.from_rest, 0, len(swing.joints) - 1)

    return _in_blocks(answer, ratios)


def _running(motion: Motion, ratios: ArrayLike, damping_ratio: float, asked: Asked) -> Numbers:
    check_velocity(motion)
    move = _first_move(motion)

    def answer(block: Floats) -> Floats:
        damping = UNDERDAMPED.number(damping_ratio)
        swing = Swing(motion.curve, block, damping, move.angle_deg, abs(move.change_mm))
        if swing.endless.any():
            raise InputError(
                f"At the period ratio {block[swing.endless][0]:g} the mass swings a whole number "
                "of times in a turn and nothing damps it, so that no turn settles how it swings, "
                "and it may swing more with each: give a damping ratio, or leave this ratio out."
            )
        ends = (np.argmin(np.abs(swing.joints - end)) for end in (move.from_deg, move.to_deg))
        return asked(swing, swing.steady, *map(int, ends))

    return _in_blocks(answer, ratios, DEG_PER_TURN / move.angle_deg)


def _in_blocks(
    answer: Callable[[Floats], Floats], ratios: ArrayLike, moves: float = 1.0
) -> Numbers:
    """Return the answer to all ratios, from so many at once as memory has room for.

    The curve is as long as so many moves.
    """
    asked = RATIO.array(ratios)
    masses_by_ways = asked.size * ways_for(float(asked.max())) * moves
    blocks = np.array_split(asked.ravel(), math.ceil(masses_by_ways / _MOST))
    return plain(np.concatenate([answer(b) for b in blocks if b.size]).reshape(asked.shape))
