"""The machine rates at which limits of acceleration, force and torque are met, and by whom.

What a mass takes goes with the square of the rate, what springs, weight, friction and process take
is the same at every rate. At an angle at which they are I and C, I being as at the rate N, a limit
F is met at

    N sqrt((F - C) / I)  for I > 0,   N sqrt((F + C) / -I)  for I < 0,

and what the machine bears is the least of these over the turn.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from cammotion.arguments import checked
from cammotion.arguments.by_name import by_name
from cammotion.bracketed import largest, summit
from cammotion.drive.camshaft import LOADED, Camshaft
from cammotion.drive.spans import Span
from cammotion.machine.diagram import TimingDiagram, as_diagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import (
    Floats,
    InputError,
    Quantity,
    WrongAnswerError,
    as_text,
    rate_as_text,
)

_ACCELERATION = Quantity("limit of the acceleration", "m/s2", example=4)
_FORCE = Quantity("limit of the force", "N", example=500)
_TORQUE = Quantity("limit of the torque", "N m", example=20)
_LEAST = 1e-12  # of the limit: a room below it is none
_SAME = 1e-6  # by such a share what is reached at the rate may miss the limit

Parts = Callable[[Span, Floats], tuple[Floats, Floats]]


@dataclass(frozen=True)
class RateLimit:
    """The machine rate in pieces/h at which a limit is met, by which mechanism, and where.

    `limit` is in m/s2, N or N m, as `quantity` is "acceleration", "force" or "torque". For the
    torque on the shaft `mechanism` is the one with the largest part in it. The rate is infinite,
    and the angle None, where no rate meets the limit; it is 0 where it is exceeded at any rate.
    """

    rate_per_hour: float
    quantity: str
    limit: float
    mechanism: str
    at_deg: float | None

    def __repr__(self) -> str:
        return f"RateLimit({self})"

    def __str__(self) -> str:
        """Say it in words."""
        unit = {"acceleration": "m/s²", "force": "N", "torque": "N m"}[self.quantity]
        what = f"the {self.quantity} of {as_text(self.limit, '.4g')} {unit}"
        if self.at_deg is None:
            return f"at no rate the {self.mechanism} meets {what}"
        if not self.rate_per_hour:
            return f"at any rate the {self.mechanism} exceeds {what}, at {self.at_deg:.4g} deg"
        whose = "has the largest part of" if self.quantity == "torque" else "meets"
        rate = f"at {rate_as_text(self.rate_per_hour)} pieces/h"
        return f"{rate} the {self.mechanism} {whose} {what}, at {self.at_deg:.4g} deg"


@checked
def rate_limits(
    diagram: TimingDiagram | Camshaft,
    *,
    acceleration_m_per_s2: float | Mapping[str, float] | None = None,
    force_N: float | Mapping[str, float] | None = None,  # noqa: N803 - newton
    torque_N_m: float | None = None,  # noqa: N803
) -> tuple[RateLimit, ...]:
    """Return the rates at which limits are met, the lowest first: that one limits the machine.

    `acceleration_m_per_s2` and `force_N` are a number for all motions, or numbers by their names;
    `torque_N_m` is for the torque on the shaft. Forces and torque need a Camshaft, and are looked
    at for its loaded motions; they are meant in either direction. Each rate of forces and torque is
    checked before it is returned: there the limit is reached and not exceeded. Raises InputError
    for no limit, for one that is not above 0, and for an unknown name.

    >>> import cammotion as cm
    >>> found = cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule).diagram
    >>> now = cm.EXAMPLE.diagram.peak_acceleration("die")
    >>> for limit in rate_limits(found, acceleration_m_per_s2=now):
    ...     print(f"{limit.rate_per_hour:.0f} pieces/h, where the {limit.mechanism} meets it")
    3857 pieces/h, where the mill meets it
    4540 pieces/h, where the die meets it
    >>> shaft = cm.Camshaft(found, {"die": cm.FollowerLoad(mass_kg=12, preload_N=60)})
    >>> print(f"{rate_limits(shaft, force_N=100)[0].rate_per_hour:.0f} pieces/h")
    4066 pieces/h
    """
    shaft = diagram if isinstance(diagram, Camshaft) else None
    motions = shaft.diagram if shaft else as_diagram(diagram)
    found = list(_accelerations(motions, acceleration_m_per_s2))
    if force_N is not None or torque_N_m is not None:
        if shaft is None or not shaft.loads:
            without = "a camshaft without loads" if shaft else "a diagram, which has no masses"
            raise InputError(
                f"A limit of force or torque is asked of {without}: give a Camshaft with loads, "
                "for example Camshaft(diagram, {'die': FollowerLoad(mass_kg=12)})."
            )
        found += _forces(shaft, force_N)
        found += [] if torque_N_m is None else [_torque(shaft, _TORQUE.number(torque_N_m))]
    if not found:
        raise InputError(
            "No limit is given: give at least one of acceleration_m_per_s2, force_N and "
            "torque_N_m, for example acceleration_m_per_s2=4."
        )
    return tuple(sorted(found, key=lambda limit: limit.rate_per_hour))


def _limits(
    given: float | Mapping[str, float] | None, quantity: Quantity, names: tuple[str, ...], of: str
) -> dict[str, float]:
    """Return the limit of each motion that has one."""
    what, example = quantity.name.replace("limit", "limits", 1), f"{quantity.example:g}"
    return by_name(what, given, names, quantity.number, example, of=of, one_for_all=True)


def _accelerations(
    diagram: TimingDiagram, limits: float | Mapping[str, float] | None
) -> Iterator[RateLimit]:
    """Yield the rate of each motion: the peak goes with the square of the rate."""
    for name, limit in _limits(limits, _ACCELERATION, diagram.names, "motion").items():
        motion, peak = diagram[name], diagram.peak_acceleration(name)
        rate = diagram.rate_per_hour * math.sqrt(limit / peak) if peak else math.inf
        corners = (at for p in motion.curve.derived(2).pieces for at in p.corners)
        places = motion.steps(1) or corners
        at_deg = max(places, key=lambda each: abs(each[1]))[0] % DEG_PER_TURN
        yield RateLimit(rate, "acceleration", limit, name, at_deg if peak else None)


def _forces(shaft: Camshaft, limits: float | Mapping[str, float] | None) -> Iterator[RateLimit]:
    for name, limit in _limits(limits, _FORCE, tuple(shaft.loads), LOADED).items():
        parts = partial(shaft.force_parts, name)
        rate, at_deg = _rate(shaft, parts, shaft.spans_of(name), limit)
        yield RateLimit(rate, "force", limit, name, at_deg)


def _torque(shaft: Camshaft, limit: float) -> RateLimit:
    rate, at_deg = _rate(shaft, shaft.torque_parts, shaft.spans, limit)
    asked, place = shaft.at_rate(rate) if 0 < rate < math.inf else shaft, at_deg or 0.0
    largest_part = max(shaft.loads, key=lambda name: abs(asked.torque_N_m(place, motion=name)))
    return RateLimit(rate, "torque", limit, largest_part, at_deg)


def _rate(
    shaft: Camshaft, parts: Parts, over: Sequence[Span], limit: float
) -> tuple[float, float | None]:
    """Return the rate at which a limit is met, and where; infinity and None for none."""

    def room(span: Span, angles: Floats) -> tuple[Floats, Floats]:
        """Return what the masses take, and what the rest leaves of the limit in their direction."""
        inertia, standing = parts(span, angles)
        return np.abs(inertia), limit - np.sign(inertia) * standing

    def share(span: Span, angles: Floats) -> Floats:
        taken, left = room(span, angles)
        return taken / np.maximum(left, _LEAST * limit)

    def asked(span: Span, angles: Floats, faster: float) -> Floats:
        """Return what is asked with so many times the square of the rate."""
        inertia, standing = parts(span, angles)
        return np.abs(faster * inertia + standing)

    most = largest(partial(asked, faster=0.0), over)
    if most.value > limit * (1 + _SAME):
        return 0.0, most.at_deg
    found, span = summit(share, over)
    at_deg = found.at_deg % DEG_PER_TURN
    if found.value <= 0:
        return math.inf, None
    if room(span, np.array([found.at_deg]))[1] <= 2 * _LEAST * limit:
        return 0.0, at_deg
    rate = shaft.diagram.rate_per_hour / math.sqrt(found.value)
    peak = largest(partial(asked, faster=1 / found.value), over).value
    if not math.isclose(peak, limit, rel_tol=_SAME):
        told = f"at {rate:g} pieces/h the peak is {peak:g} and not {limit:g}"
        raise WrongAnswerError("rate_limits", told)
    return rate, at_deg
