"""A follower that leaves its cam and hits it again: one turn, with the gap made large.

On the left the cam turns under the follower's roller, which a spring presses down; on the right
are the displacement of both and the force between them. The picture is the last turn of the
flights. What is magnified is the gap alone, and the picture says how much.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import drawsvg as draw
import numpy as np

from cammotion.arguments import checked
from cammotion.dynamics.contact import Flights
from cammotion.dynamics.turns import Flight
from cammotion.hardware.followers import TranslatingRoller
from cammotion.hardware.prime_circle import smallest_prime_radius
from cammotion.hardware.roller_cam import RollerCam
from cammotion.machine.arcs import Arc, arcs
from cammotion.machine.kinematics import DEG_PER_TURN, cycle_time, into_turn
from cammotion.quantities import Floats, InputError, Quantity, as_text
from cammotion.views.animation import svg
from cammotion.views.animation.dial import draw_dial
from cammotion.views.animation.keyframes import CAMSHAFT, Trace
from cammotion.views.animation.leaving_charts import CAM, FOLLOWER, Curves, draw_charts
from cammotion.views.animation.moving_picture import MovingPicture
from cammotion.views.animation.picture import TURN
from cammotion.views.animation.player import SHOWN_ANGLE
from cammotion.views.animation.still import Still, stopped
from cammotion.views.displacement import within_short_moves
from cammotion.views.names import printable
from cammotion.views.plots import colour

MAGNIFICATION = Quantity("magnification of the gap", "times", example=10, low=1, low_included=True)
WIDTH_PX, HEIGHT_PX = 800, 430
_CAM_PX = 118.0  # the largest radius of the cam
_AXIS = (150.0, 300.0)
_CEILING, _TOP, _HEADER = 78.0, 54.0, 66.0  # where the spring ends, and where at the highest
_CHART_X = 310.0
_ROLLER, _PRESSURE_DEG = 0.35, 38  # of the travel; the cam is no larger than a picture needs
_SEEN = 0.35  # of the travel: so wide is the widest gap to be drawn
_STEP_DEG, _BURST_DEG = 1.0, 9.0
_STEM_PX, _COILS = 46.0, 5
_OVER_PX = _STEM_PX + 6 + 22  # of stem, plate and spring over the roller where it is highest


@dataclass(frozen=True)
class FollowerAnimation(MovingPicture):
    """A turn of a follower that leaves its cam; made by `animate_follower`."""

    flights: Flights
    magnify: float
    turn_s: float

    @cached_property
    def svg(self) -> str:
        """The SVG, which moves by itself; the same flights give the same text."""
        return _Picture(self).draw()

    def still(self, angle_deg: float) -> Still:
        """Return the picture at a cam angle from 0 to 360 deg; InputError for any other angle."""
        angle = SHOWN_ANGLE.number(angle_deg)
        gap = float(self.flights.gap_mm(self.angle_of(angle)))
        said = f"{as_text(gap, '.3g')} mm above the cam" if gap else "on the cam"
        return Still(
            stopped(self.svg, angle), f"At a cam angle of {angle:g}° the follower is {said}."
        )

    @property
    def cycle_s(self) -> float:
        """How long a turn takes in the machine, in s."""
        return float(cycle_time(self.flights.rate_per_hour))

    @property
    def seen(self) -> tuple[Flight, ...]:
        """The flights of the turn that is shown."""
        return self.flights.last_turn

    @property
    def carried(self) -> Flight | None:
        """The flight in which the turn that is shown begins, if the turn is another than before."""
        return None if self.flights.period == 1 else self.flights.into_last_turn

    @property
    def ends_at_deg(self) -> float:
        """Where the turn that is shown ends, counted on from the first one."""
        return self.flights.begins_at_deg + self.flights.turns * DEG_PER_TURN

    @property
    def landing(self) -> list[Flight]:
        """The flights that end in the turn that is shown, or in one like it."""
        flights = [*filter(None, [self.carried]), *self.seen]
        is_alike = self.flights.period == 1
        return [each for each in flights if is_alike or each.lands_at_deg < self.ends_at_deg]

    @property
    def description(self) -> str:
        """What there is to see, in words."""
        found = self.flights
        said = [
            f"A follower on its cam, {self.cycle_s:.4g} s a turn ({found.rate_per_hour:g} "
            f"pieces/h), shown in {self.turn_s:g} s."
        ]
        said += [self._coming] if self.carried else []
        for flight in self.seen:
            leaves, off = flight.leaves_at_deg % DEG_PER_TURN, as_text(flight.gap_mm, ".3g")
            comes = (
                f"hits it {_impact(flight)}" if flight in self.landing else "lands in a later turn"
            )
            said.append(f"It leaves the cam at {leaves:.4g}°, by up to {off} mm, and {comes}.")
        if not self.seen and not self.carried:
            said.append("It stays on the cam.")
        elif self.magnify > 1:
            said.append(f"The gap is drawn {self.magnify:g} times as large.")
        if not self.is_repeated:
            said.append("The turn before was another: the picture jumps where this one begins.")
        return "\n".join(said)

    @property
    def _coming(self) -> str:
        """How a follower that comes into the turn in the air lands in it, if it does."""
        if self.carried in self.landing:
            return f"It comes into the turn in the air, and hits the cam {_impact(self.carried)}."
        return "It is in the air all the turn, and does not come back to the cam in it."

    @property
    def is_repeated(self) -> bool:
        """Whether the turn that is shown is as the one before it, if there was one."""
        return self.flights.turns < 2 or self.flights.period == 1  # noqa: PLR2004

    def angle_of(self, angle_deg: Any) -> Any:
        """Return angles of the dial as those of the last turn, counted on from the first."""
        first = self.flights.begins_at_deg + (self.flights.turns - 1) * DEG_PER_TURN
        return into_turn(np.asarray(angle_deg), first)[1]


@checked
def animate_follower(
    flights: Flights, *, magnify: float | None = None, turn_s: float = 9.0
) -> FollowerAnimation:
    """Show the last turn of a follower that leaves its cam and hits it again, in motion.

    `flights` is what `follower_flights` returns. The gap is drawn `magnify` times as large, from 1
    on; without it so that it can be seen. `turn_s` is how long the turn takes in the SVG, in s.
    Raises InputError for anything else, for less than one whole turn, and for a motion that stands
    still or that no roller's cam can give.

    >>> import cammotion as cm
    >>> load = cm.FollowerLoad(mass_kg=12, stiffness_N_per_mm=1, preload_N=30)
    >>> print(animate_follower(cm.follower_flights(cm.EXAMPLE.die, load, 3000)).description)
    A follower on its cam, 1.2 s a turn (3000 pieces/h), shown in 9 s.
    It leaves the cam at 182.9°, by up to 4.29 mm, and hits it at 216.4° with 0.242 m/s.
    It leaves the cam at 311.9°, by up to 4.38 mm, and hits it at 344.3° with 0.314 m/s.
    The gap is drawn 2 times as large.
    """
    if flights.turns < 1:
        raise InputError(
            f"The flights are those of {flights.turns:g} turns: ask for at least 1, to see one."
        )
    low, high = flights.motion.range_mm
    if low == high:
        raise InputError(
            f"The motion '{flights.motion.name}' stands still, so that its follower never leaves "
            "the cam: give the flights of one that moves."
        )
    times = _fitting(flights) if magnify is None else MAGNIFICATION.number(magnify)
    return FollowerAnimation(flights, times, TURN.number(turn_s))


def _fitting(flights: Flights) -> float:
    """Return 1, 2, 5, 10, ... as the widest gap of the turn needs it to be seen."""
    low, high = flights.motion.range_mm
    shown = filter(None, [*flights.last_turn, flights.into_last_turn])
    widest = max((flight.gap_mm for flight in shown), default=0.0)
    steps = [step * 10.0**decade for decade in range(6) for step in (1, 2, 5)]
    fit = [step for step in steps if widest * step <= _SEEN * (high - low)]
    return max(fit, default=1.0) if widest else 1.0


def _impact(flight: Flight) -> str:
    lands = flight.lands_at_deg % DEG_PER_TURN
    return f"at {lands:.4g}° with {as_text(flight.impact_m_per_s, '.3g')} m/s"


class _Picture:
    """The drawing, in px."""

    def __init__(self, animation: FollowerAnimation) -> None:
        self.of, self.turn_s = animation, animation.turn_s
        motion = animation.flights.motion
        low, high = motion.range_mm
        self.travel = high - low
        roller = TranslatingRoller(_ROLLER * self.travel)
        prime = smallest_prime_radius(
            motion, roller, pressure_angle_deg=_PRESSURE_DEG, profile_radius_mm=0.3 * self.travel
        )
        self.cam = RollerCam(motion, roller, max(prime, 1.5 * self.travel))
        ends = [end for flight in animation.seen for end in flight[:2]]
        ends += [flight.lands_at_deg for flight in animation.landing]
        even = np.arange(0, DEG_PER_TURN + _STEP_DEG / 2, _STEP_DEG)
        own = np.mod([*ends, motion.start_deg, *within_short_moves(motion)], DEG_PER_TURN)
        self.angles: Floats = np.union1d(even, own)
        whole = animation.angle_of(self.angles)
        self.gap = np.asarray(animation.flights.gap_mm(whole)) * animation.magnify
        self.lift = np.asarray(motion.position_mm(whole)) - low
        self.force = np.asarray(animation.flights.force_N(whole))
        self.scale = min(
            _CAM_PX / (self.cam.prime_radius_mm + self.travel - roller.radius_mm),
            (_AXIS[1] - _OVER_PX - _TOP) / (self.cam.prime_radius_mm + float(self._drawn.max())),
        )

    def draw(self) -> str:
        """Draw it all and return the SVG."""
        title = "A follower leaves its cam"
        drawing = svg.sheet(WIDTH_PX, HEIGHT_PX, title, printable(self.of.description))
        drawing.extend([*self._header(), *self._machine(), *self._bursts()])
        drawing.append(svg.placed(_CHART_X, _HEADER, *draw_charts(self._curves, self.turn_s)))
        return str(drawing.as_svg(header=""))

    def _header(self) -> Iterable[Any]:
        rate = self.of.flights.rate_per_hour
        yield svg.label(
            f"One turn at {rate:g} pieces/h", 12, 22, size=svg.LARGE, font_weight="bold"
        )
        if self.of.magnify > 1:
            yield svg.label(f"the gap is drawn {self.of.magnify:g} times as large", 12, 42)
        if not self.of.is_repeated:
            yield svg.label("the turn before was another", _CHART_X + 48, 42)
        yield svg.placed(WIDTH_PX - 40, 27, draw_dial(self.turn_s))

    def _machine(self) -> Iterable[Any]:
        """Draw the cam, and the follower with its spring."""
        places = self.cam.profile_mm(np.arange(0, DEG_PER_TURN, _STEP_DEG)) * self.scale
        turning = svg.moving(CAMSHAFT, self.turn_s, "rotate", data={"part": "cam"})
        style = {"fill": svg.pale(CAM), "stroke": colour(CAM), "stroke_width": 2}
        shape = svg.polyline([(x, -y) for x, y in places], **style, data_part="profile")
        shape.Z()
        turning.append(shape)
        turning.append(draw.Circle(0, 0, 12, **svg.STEEL))
        turning.append(svg.box(-2.5, -15, 5, 6, fill="#555555"))  # the key
        yield svg.placed(*_AXIS, turning)
        yield svg.label("cam", _AXIS[0], _AXIS[1] + 34, text_anchor="middle", fill=svg.dark(CAM))
        yield from self._follower()

    def _follower(self) -> Iterable[Any]:
        x, axis = _AXIS
        heights = Trace(self.angles, axis - self.scale * (self.cam.prime_radius_mm + self._drawn))
        roller = self.cam.roller_radius_mm * self.scale
        body = svg.moving(heights, self.turn_s, data={"part": "follower"})
        style = {"fill": svg.pale(FOLLOWER), "stroke": colour(FOLLOWER), "stroke_width": 2}
        body.append(svg.box(-5, -_STEM_PX, 10, _STEM_PX, **style))
        body.append(svg.box(-19, -_STEM_PX - 6, 38, 7, **style))
        body.append(draw.Circle(0, 0, svg.px(roller), **style, data_part="roller"))
        body.append(draw.Circle(0, 0, 3, fill=colour(FOLLOWER)))
        yield svg.placed(x, heights.values[0], body)
        lengths = heights.values - _STEM_PX - 6 - self._ceiling
        spring = svg.moving(Trace(self.angles, lengths / lengths[0]), self.turn_s, "stretch")
        coil = draw.Path(
            stroke="#555555", stroke_width=2, fill="none", vector_effect="non-scaling-stroke"
        )
        step = lengths[0] / (2 * _COILS + 1)
        coil.M(-9, 0).H(9)
        for turn in range(2 * _COILS + 1):
            coil.L(9 if turn % 2 else -9, svg.px(step * (turn + 1)))
        spring.append(coil)
        yield svg.placed(x, self._ceiling, spring)
        yield svg.box(x - 34, self._ceiling - 8, 68, 8, fill="#9a9a9a")
        yield svg.label("spring", x + 24, self._ceiling + 18)
        yield svg.label("follower", x + 26, heights.values.max() - 18, fill=svg.dark(FOLLOWER))

    @property
    def _drawn(self) -> Floats:
        return np.asarray(self.lift + self.gap)

    @property
    def _ceiling(self) -> float:
        """Where the spring ends above, as high as the follower comes, and a spring's length."""
        highest = _AXIS[1] - self.scale * (self.cam.prime_radius_mm + float(self._drawn.max()))
        return float(min(highest - _OVER_PX, _CEILING))

    def _bursts(self) -> Iterable[Any]:
        """Draw a word while the follower is in the air, and a star where it lands."""
        alarm: dict[str, Any] = {"fill": svg.ALARM, "font_weight": "bold"}
        if self._air:
            air = svg.seen_during(self._air, self.turn_s)
            air.append(svg.label("in the air", 14, _HEADER + 12, size=svg.LARGE, **alarm))
            yield air
        for flight in self.of.landing:
            lands = flight.lands_at_deg % DEG_PER_TURN
            hit = svg.seen_during(arcs([(lands, lands + _BURST_DEG)]), self.turn_s)
            lift = float(np.interp(lands, self.angles, self.lift))
            top = self.cam.prime_radius_mm - self.cam.roller_radius_mm + lift
            star = draw.Path(stroke=svg.ALARM, stroke_width=2.5, fill="none")
            for turned in np.radians([200, 225, -20, -45, 160, 20]):
                way = np.array([np.cos(turned), np.sin(turned)])
                star.M(*map(svg.px, 12 * way)).L(*map(svg.px, 25 * way))
            hit.append(svg.placed(_AXIS[0], _AXIS[1] - top * self.scale, star))
            hit.append(
                svg.label(f"{as_text(flight.impact_m_per_s, '.2g')} m/s", 14, _HEADER + 30, **alarm)
            )
            yield hit

    @cached_property
    def _air(self) -> list[Arc]:
        of, last = self.of, self.of.ends_at_deg
        own = [*of.seen, *filter(None, [of.carried])]
        if of.flights.period == 1:
            return arcs([flight[:2] for flight in own])
        first = last - DEG_PER_TURN
        return arcs([(max(f.leaves_at_deg, first), min(f.lands_at_deg, last)) for f in own])

    @property
    def _curves(self) -> Curves:
        return Curves(self.angles, self.lift, self._drawn, self.force, self._air, self.of.magnify)
