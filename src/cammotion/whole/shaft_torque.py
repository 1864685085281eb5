"""The torque on a camshaft over the starts and the angles of moves, for who seeks the best ones.

A move with a law, of the way h in the angle B, has the velocity h S'(u) / B and the acceleration
h S''(u) / B^2 at the share u of its angle. So the torque of its mass goes with 1 / B^3, and that of
all else with 1 / B: two tables for a law and its load, made once, say it for all starts and angles.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from cammotion.drive.camshaft import Camshaft
from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M, over_time
from cammotion.machine.segments import Segment
from cammotion.quantities import Floats

_TABLE = 800  # places of each piece of a law, between which the tables are straight
_FEWEST = 5  # samples of a piece
_BESIDE = 1e-9  # of a piece: so far from its ends its samples are
_BESIDE_DEG = 1e-7


class Push(NamedTuple):
    """What a move asks of the shaft at shares of its angle: the torque if it takes 1 deg.

    `of_mass` goes with the angle to the power -3, `standing` and `way` with its inverse; `way`
    times a force of the process in N is its torque. `places` are close samples of the shares.
    """

    motion: str
    shares: Floats
    of_mass: Floats
    standing: Floats
    way: Floats
    places: Floats


def push(shaft: Camshaft, name: str, move: Segment, law: MotionLaw, samples: int) -> Push:
    """Return what a move of a loaded motion asks with this law."""
    load, change = shaft.loads[name], move.change_mm
    tables, places = [], []
    each = max(samples // len(law.curve.pieces), _FEWEST)
    for piece in law.curve.pieces:
        near = _BESIDE * (piece.high - piece.low)
        places.append(np.linspace(piece.low + near, piece.high - near, each))
        shares = np.linspace(piece.low, piece.high, _TABLE)
        first = piece.derivative
        curves = (one.over(shares.copy()) for one in (piece, first, first.derivative))
        tables.append([shares, *curves])
    shares, position, velocity, acceleration = np.hstack(tables)
    way = math.degrees(1) / MM_PER_M * change * velocity  # m/rad
    lift = move.from_mm + change * position - shaft.diagram[name].range_mm[0]
    friction = shaft.friction_N.get(name, 0.0) * np.sign(way)
    force = load.mass_kg * over_time(2, change * acceleration, shaft.diagram.cycle_time_s)
    standing = load.standing_N(lift) + friction
    return Push(name, shares, way * force, way * standing, way, np.hstack(places))


class ShaftTorque:
    """The torque of some moves, of which each has a start and an angle in deg, and of all others.

    Starts and angles are an array with a line for each move; those of a move without a load (None)
    do not matter.
    """

    def __init__(
        self, shaft: Camshaft, pushes: Sequence[Push | None], free: Sequence[str], samples: int
    ) -> None:
        self.process, self.pushes = shaft.process, list(pushes)
        ends = [end for force in shaft.process for end in (force.from_deg, force.to_deg)]
        self.ends = np.array([end + side * _BESIDE_DEG for end in ends for side in (-1, 1)])
        others = [
            (name, move)
            for name in shaft.loads
            if name not in free
            for move in shaft.diagram[name].moves
        ]
        self.fixed = np.array([(m.from_deg, m.angle_deg) for _, m in others]).reshape(-1, 2)
        self.pushes += [push(shaft, n, m, as_law(m.law), samples) for n, m in others]

    @property
    def size(self) -> float:
        """The torque in N m that the hardest move would ask if it took the whole turn."""
        asked = (
            np.abs(one.of_mass).max() / DEG_PER_TURN**3 + np.abs(one.standing).max() / DEG_PER_TURN
            for one in self.pushes
            if one is not None
        )
        return float(max(asked, default=0.0))

    def at_samples(self, moves: Floats) -> Floats:
        """Return the torque in N m at close samples of all moves."""
        every = [*zip(self.pushes, [*moves, *self.fixed], strict=True)]
        loaded = [(one, start, angle) for one, (start, angle) in every if one is not None]
        places = [start + angle * one.places for one, start, angle in loaded]
        angles = np.concatenate([*places, self.ends])
        torque = np.zeros(len(angles))
        for one, start, angle in loaded:
            since = np.mod(angles - start, DEG_PER_TURN)
            here = since < angle
            if not here.any():  # it is hardly there
                continue
            share = since[here] / angle
            torque[here] += np.interp(share, one.shares, one.of_mass) / angle**3
            standing = np.interp(share, one.shares, one.standing)
            for force in self.process:
                if force.motion == one.motion:
                    way = np.interp(share, one.shares, one.way)
                    standing = standing + force.at(angles[here]) * way
            torque[here] += standing / angle
        return torque
