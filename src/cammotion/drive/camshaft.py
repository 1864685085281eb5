"""What the mechanisms ask of their camshaft: the force of each, and the torque over the turn.

The cams are taken as without losses, and the camshaft as turning evenly. So the torque is the power
of all mechanisms over the speed of the shaft,

    T = sum F v / Omega = sum F ds/dtheta,

positive while the shaft drives, negative while the mechanisms do.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cammotion.alike import Alike
from cammotion.arguments import warn
from cammotion.arguments.by_name import by_name
from cammotion.bracketed import Extreme, summit
from cammotion.drive.process import ProcessForce, force_beside
from cammotion.drive.spans import Moved, Span, SpanFunction, nodes, running_extremes, spans, ways
from cammotion.dynamics.loads import FollowerLoad, check_spring
from cammotion.machine.diagram import TimingDiagram, as_diagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import CAM_ANGLE
from cammotion.quantities import Floats, InputError, Numbers, Quantity, one_of, plain, shorten

LOADED = "load of a motion"  # what is there of some names only
_LOAD = "FollowerLoad(mass_kg=12)"
_FRICTION = Quantity("friction", "N", example=20, low_included=True)
_INERTIA = Quantity("inertia of the drive", "kg m2", example=2, low_included=True)
_SMALL_RIPPLE = 0.2  # a tenth up and down, and what the masses ask by a fifth


@dataclass(frozen=True, eq=False)
class Camshaft(Alike):
    """The camshaft of a diagram, and what it has to move.

    `loads` says by the name of a motion what moves with it: a FollowerLoad with its mass, spring
    and weight; for a turret the mass is its inertia over the square of the radius at which its mm
    are measured. `process` are forces of the process, `friction_N` is by the name what holds a
    mechanism back while it moves. A motion without a load asks nothing of the shaft.
    `inertia_kg_m2` is that of the drive and of what else turns with the shaft, reflected to it: a
    motor's times the square of its gear ratio. The shaft is taken as turning evenly, and then this
    inertia takes no torque; how far from even it is says `speed_ripple`. Raises InputError for a
    name that is unknown or without a load, for a motion whose velocity jumps, for a spring on a
    motion that does not come back, and for numbers out of range.

    >>> import cammotion as cm
    >>> shaft = Camshaft(
    ...     cm.EXAMPLE.diagram, {"die": FollowerLoad(mass_kg=12), "mill": FollowerLoad(mass_kg=40)})
    >>> print(f"{abs(shaft.peak_torque().value):.2f} N m, rms {shaft.rms_torque_N_m:.2f} N m")
    3.37 N m, rms 1.43 N m
    """

    diagram: TimingDiagram
    loads: Mapping[str, FollowerLoad]
    process: Sequence[ProcessForce] = ()
    friction_N: Mapping[str, float] = field(default_factory=dict)  # noqa: N815
    inertia_kg_m2: float = 0.0

    def __post_init__(self) -> None:
        motions = as_diagram(self.diagram).names
        loads = by_name("loads", self.loads, motions, _load, f"loads={{'die': {_LOAD}}}")
        object.__setattr__(self, "loads", MappingProxyType(loads))
        example, read = "friction_N={'die': 20}", _FRICTION.number
        friction = by_name("forces of friction", self.friction_N, loads, read, example, of=LOADED)
        object.__setattr__(self, "friction_N", MappingProxyType(friction))
        forces: Any = self.process
        is_list = isinstance(forces, Sequence)
        process = tuple(forces) if is_list else (None,)
        if not all(isinstance(force, ProcessForce) for force in process):
            raise InputError(
                f"The forces of the process are {shorten(forces)}: give a list of ProcessForce."
            )
        spelled = (replace(force, motion=self._loaded(force.motion)) for force in process)
        object.__setattr__(self, "process", tuple(spelled))
        object.__setattr__(self, "inertia_kg_m2", _INERTIA.number(self.inertia_kg_m2))
        for name in self.loads:
            self._check_motion(name)

    def __repr__(self) -> str:
        return f"Camshaft({shorten(', '.join(self.loads), of=str)} of {self.diagram!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        parts = (dict(self.loads), self.process, dict(self.friction_N), self.inertia_kg_m2)
        return type(self), (self.diagram, *parts)

    def at_rate(self, rate_per_hour: float) -> "Camshaft":
        """Return the same shaft at another machine rate, in pieces/h."""
        return replace(self, diagram=self.diagram.at_rate(rate_per_hour))

    def force_N(self, motion: str | Motion, angle_deg: ArrayLike) -> Numbers:  # noqa: N802 (here and below)
        """Return the force in N that the cam has on a mechanism at a cam angle, a number or array.

        It is in the direction of the motion, above 0 towards higher positions; at a joint it is
        what begins there. Raises InputError for a name without a load.
        """
        return plain(self._force(self._loaded(motion), CAM_ANGLE.array(angle_deg))[0])

    def torque_N_m(self, angle_deg: ArrayLike, *, motion: str | Motion | None = None) -> Numbers:  # noqa: N802
        """Return the torque on the shaft in N m at a cam angle; of one mechanism, if one is given.

        >>> import cammotion as cm
        >>> shaft = Camshaft(cm.EXAMPLE.diagram, {"die": FollowerLoad(mass_kg=12)})
        >>> shaft.torque_N_m([150, 163.75, 177.5, 191.25]).round(3)
        array([ 0.   ,  2.597,  0.   , -2.597])
        """
        angle = CAM_ANGLE.array(angle_deg)
        names = self.loads if motion is None else [self._loaded(motion)]
        power = (force * velocity for force, velocity in (self._force(n, angle) for n in names))
        return plain(sum(power, np.zeros(angle.shape)) / self.speed_rad_per_s)

    def reflected_inertia_kg_m2(self, angle_deg: ArrayLike) -> Numbers:
        """Return what a start has to speed up at a cam angle, in kg m2: drive and all masses.

        A mass counts with the square of its way in m for each rad of the shaft.

        >>> import cammotion as cm
        >>> shaft = Camshaft(cm.EXAMPLE.diagram, {"die": FollowerLoad(mass_kg=12)}, inertia_kg_m2=2)
        >>> shaft.reflected_inertia_kg_m2([150, 177.5]).round(3)
        array([2.  , 2.13])
        """
        angle, rate = CAM_ANGLE.array(angle_deg), self.diagram.rate_per_hour
        inertia = np.full(angle.shape, float(self.inertia_kg_m2))
        for name, load in self.loads.items():
            velocity = self.diagram[name].derivative(1, angle, rate)
            inertia += load.mass_kg * (velocity / self.speed_rad_per_s) ** 2
        return plain(inertia)

    def peak_force(self, motion: str | Motion) -> Extreme:
        """Return the largest force of a mechanism in N, of either sign, and the cam angle of it."""
        name = self._loaded(motion)
        return _peak(
            lambda span, at: np.add(*self.force_parts(name, span, at)), self.spans_of(name)
        )

    def peak_torque(self) -> Extreme:
        """Return the largest torque on the shaft in N m, of either sign, and the cam angle."""
        return _peak(self._torque, self.spans)

    @property
    def speed_rad_per_s(self) -> float:
        """The speed of the shaft in rad/s."""
        return 2 * math.pi / self._cycle_s

    @property
    def mean_torque_N_m(self) -> float:  # noqa: N802
        """The mean torque in N m: what process and friction take, since masses give all back."""
        torque, weights = self._at_nodes
        return float(weights @ torque)

    @property
    def mean_power_W(self) -> float:  # noqa: N802
        """The mean power in W."""
        return self.mean_torque_N_m * self.speed_rad_per_s

    @property
    def rms_torque_N_m(self) -> float:  # noqa: N802
        """The root mean square of the torque in N m, as it heats a motor that turns evenly."""
        torque, weights = self._at_nodes
        return math.sqrt(float(weights @ torque**2))

    @cached_property
    def energy_swing_J(self) -> float:  # noqa: N802
        """The energy in J that goes in and out of the drive in a turn, about the mean torque."""
        mean = self.mean_torque_N_m
        low, high = running_extremes(lambda span, at: self._torque(span, at) - mean, self.spans)
        return math.radians(high - low)

    @property
    def speed_ripple(self) -> float:
        """How far the speed swings in a turn, as a part of it: the energy over I Omega^2.

        It takes a motor that gives the mean torque alone, and a ripple that is small: then the
        speed may be taken as even. Above 20 % there is a UserWarning. Raises InputError without an
        inertia of the drive.

        >>> import cammotion as cm
        >>> loads = {"die": FollowerLoad(mass_kg=12), "mill": FollowerLoad(mass_kg=40)}
        >>> shaft = Camshaft(cm.EXAMPLE.diagram, loads, inertia_kg_m2=2)
        >>> print(f"{100 * shaft.speed_ripple:.1f} %")
        5.8 %
        """
        if not self.inertia_kg_m2:
            raise InputError(
                "The inertia of the drive is 0 kg m2, and without one nothing keeps the speed "
                "even: give it, for example inertia_kg_m2=2."
            )
        ripple = self.energy_swing_J / (self.inertia_kg_m2 * self.speed_rad_per_s**2)
        if ripple > _SMALL_RIPPLE:
            warn(
                f"The speed would swing by {100 * ripple:.3g} % in a turn, but the torque is that "
                f"of an even speed: with {self.inertia_kg_m2:g} kg m2 the ripple is not true any "
                "more. Give a larger inertia_kg_m2."
            )
        return ripple

    @cached_property
    def spans(self) -> tuple[Span, ...]:
        """The turn, cut where a loaded motion is not smooth or a force of the process begins."""
        return self._spans(*self.loads)

    def spans_of(self, motion: str | Motion) -> tuple[Span, ...]:
        """Return the turn, cut where one mechanism is not smooth or a force on it begins."""
        name = self._loaded(motion)
        if name not in self._own_spans:  # a rate and a peak ask for the same
            self._own_spans[name] = self._spans(name)
        return self._own_spans[name]

    def force_parts(
        self, motion: str | Motion, span: Span, angle_deg: Floats
    ) -> tuple[Floats, Floats]:
        """Return the force in N of a mechanism at angles in a span: of its mass, and the rest.

        The first part goes with the square of the rate, the second is the same at every rate.
        """
        name = self._loaded(motion)
        moved = span.moved(name, angle_deg, self._cycle_s)
        return self._parts(name, moved, span.way(name), angle_deg, span.middle)

    def torque_parts(self, span: Span, angle_deg: Floats) -> tuple[Floats, Floats]:
        """Return the torque in N m at angles in a span: of the masses, and the rest."""
        inertia, standing = np.zeros(angle_deg.shape), np.zeros(angle_deg.shape)
        for name in filter(span.moves, self.loads):
            arm = span.moved(name, angle_deg, self._cycle_s).velocity / self.speed_rad_per_s
            of_mass, rest = self.force_parts(name, span, angle_deg)
            inertia += arm * of_mass
            standing += arm * rest
        return inertia, standing

    def _loaded(self, motion: str | Motion) -> str:
        name = self.diagram[motion].name if isinstance(motion, Motion) else motion
        return one_of(LOADED, name, self.loads)

    def _torque(self, span: Span, angles: Floats) -> Floats:
        return np.add(*self.torque_parts(span, angles))

    @cached_property
    def _at_nodes(self) -> tuple[Floats, Floats]:
        """The torque at places of the turn, and what share each has in its mean."""
        placed = [(span, *nodes(span)) for span in self.spans]
        torque = [self._torque(span, places) for span, places, _ in placed]
        weights = [weights for _, _, weights in placed]
        return np.concatenate(torque), np.concatenate(weights) / DEG_PER_TURN

    @cached_property
    def _own_spans(self) -> dict[str, tuple[Span, ...]]:
        return {}

    def _spans(self, *names: str) -> tuple[Span, ...]:
        forces = (force for force in self.process if force.motion in names)
        ends = [end for force in forces for end in (force.from_deg, force.to_deg)]
        return spans([self.diagram[name] for name in names], ends)

    @cached_property
    def _cycle_s(self) -> float:
        return self.diagram.cycle_time_s

    def _force(self, name: str, angle: Floats) -> tuple[Floats, Floats]:
        """Return the force in N of a mechanism at any angles, and its velocity in m/s there."""
        motion, rate = self.diagram[name], self.diagram.rate_per_hour
        derivatives = (motion.derivative(order, angle, rate) for order in (1, 2))
        moved = Moved(*map(np.asarray, (motion.position_mm(angle), *derivatives)))
        way = ways(name, self.spans_of(name), angle) if name in self.friction_N else 0.0
        return np.add(*self._parts(name, moved, way, angle, angle)), moved.velocity

    def _parts(
        self,
        name: str,
        moved: Moved,
        way: Numbers,
        angle: Floats,
        beside: Floats | float,
    ) -> tuple[Floats, Floats]:
        """Return the force of the mass, and that of all else.

        `way` is where it moves, 1 for up. The process has at an end what it has `beside` it.
        """
        load, friction = self.loads[name], self.friction_N.get(name, 0.0)
        standing = load.standing_N(moved.position_mm - self._lowest_mm[name]) + friction * way
        for force in self.process:
            if force.motion == name:
                standing = standing + force_beside(force, angle, beside)
        return load.mass_kg * moved.acceleration, np.asarray(standing)

    @cached_property
    def _lowest_mm(self) -> dict[str, float]:
        return {name: self.diagram[name].range_mm[0] for name in self.loads}

    def _check_motion(self, name: str) -> None:
        motion, load = self.diagram[name], self.loads[name]
        if steps := motion.steps(1):
            raise InputError(
                f"The velocity of {name!r} jumps at {steps[0][0]:g} deg, and no force moves a mass "
                "like that: give it a law from rest to rest, for example 'cycloidal'."
            )
        check_spring(load, motion)


def _load(given: Any) -> FollowerLoad:
    if isinstance(given, FollowerLoad):
        return given
    raise InputError(f"A {LOADED} is {shorten(given)}: give a FollowerLoad, for example {_LOAD}.")


def _peak(function: SpanFunction, over: Sequence[Span]) -> Extreme:
    """Return what has the largest magnitude, with its sign."""
    found, span = summit(lambda span, at: np.abs(function(span, at)), over)
    value = float(function(span, np.array([found.at_deg]))[0])
    return Extreme(value, found.at_deg % DEG_PER_TURN)
