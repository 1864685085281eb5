"""An answer in degrees or as a time, in a turn of the machine: mill above, die below."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cammotion.laws.catalogue import LAWS
from cammotion.limits.widest import with_angle
from cammotion.machine.kinematics import DEG_PER_TURN, cycle_time
from cammotion.quantities import Floats
from cammotion.rules.checks import smallest_clearance
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.shown.frame import (
    DIE,
    DIE_TEXT,
    GREY,
    MILL,
    MILL_TEXT,
    PALE_DIE,
    PALE_MILL,
    PALEST_MILL,
    WIDTH,
    Frame,
    Shown,
    Shows,
)
from cammotion.teaching.shown.strikes import ROUNDING, die_from, find_strike, fits_turn

_LEFT, _RIGHT = 44, WIDTH - 12
_MILL_TOP, _MILL_BOTTOM, _DIE_TOP, _DIE_BOTTOM, _AXIS = 10, 34, 52, 142, 160
_SAMPLES, _FINE = 150, 3000
_ROOM_FOR_WORD = 50  # px
_NO_ROOM = (
    "Two such ways and the work take more than a turn: the die would have to set off again before "
    "it is up."
)
_MS, _TENS = 1000, 10


def way_after(*, quiet: bool = False) -> Shows:
    """Show an answer as the degrees of each way of the die, which waits until the mill is still.

    With `quiet` the mill counts as still in the quiet ends of its move.
    """

    def show(machine: MillAndDie, angle_deg: float) -> Shown:
        start = machine.mill_angle_deg - (machine.quiet_deg if quiet else 0)
        turn = Turn(machine, start, angle_deg, machine.work_deg, quiet=quiet)
        return turn.show(
            turn.end(
                late=(
                    "The die is not up yet when the mill gets going again: it moves while it may "
                    "not."
                ),
                early=(
                    "The die is up before the mill gets going again, and waits: degrees that "
                    "nobody uses."
                ),
                fits="It is up just when the mill gets going again: the turn closes.",
            )
        )

    return show


def work_in_turn(machine: MillAndDie, time_s: float) -> Shown | None:
    """Show an answer in s as the time for which the die stays down."""
    work = time_s / float(cycle_time(machine.rate_per_hour)) * DEG_PER_TURN
    if work > DEG_PER_TURN + ROUNDING:
        return None
    turn = Turn(machine, machine.mill_angle_deg, machine.die_angle_deg, work)
    said = turn.end(
        late="It is not up yet when the mill sets off.",
        early="It is up again too early, with its work cut short.",
        fits="It is up again just when the mill sets off.",
    )
    part = f"about {round(work, -1):.0f}" if work >= _TENS else f"less than {_TENS}"
    return turn.show(f"At this rate it is down for {part} of the 360 degrees. {said}")


def widened_way(machine: MillAndDie, angle_deg: float) -> Shown:
    """Show an answer as the indexing angle of the die that is down when it has to be."""
    start = machine.down_deg - angle_deg
    turn = Turn(machine, start, angle_deg, machine.work_deg, quiet=True)
    if not fits_turn(angle_deg, machine.work_deg):
        return turn.show(_NO_ROOM)
    die = with_angle(machine.die, angle_deg)
    if strike := find_strike(machine, die):
        return turn.show(strike.said)
    room = smallest_clearance(machine.diagram.with_motion(die), machine.rule).clearance_mm
    if room < ROUNDING:
        return turn.show(
            "It is just as deep as it may be where the quiet end of the mill's move begins."
        )
    return turn.show(
        f"It keeps clear, by more than it has to: where the quiet end of the mill's move begins it "
        f"might be {room:.1f} mm deeper. It sets off late, and is pushed harder for it."
    )


def rest_in_turn(machine: MillAndDie, time_ms: float) -> Shown | None:
    """Show an answer in ms as the time for which the overlapped die rests at the top."""
    turn_ms = _MS * float(cycle_time(machine.rate_per_hour))
    rest, way, work = time_ms / turn_ms * DEG_PER_TURN, machine.told_deg, machine.work_deg
    if rest > DEG_PER_TURN:
        return None
    over = 2 * way + work + rest - DEG_PER_TURN
    if abs(over) < ROUNDING:
        said = "With this rest the die sets off again just one turn after it did."
    elif over > 0:
        said = "After this rest the die sets off too late: it falls behind the mill, turn by turn."
    else:
        said = "After this rest the die sets off too soon: it gets ahead of the mill, turn by turn."
    turn = Turn(machine, machine.down_deg - way, way, work, quiet=True, again_after_deg=rest)
    return turn.show(said)


@dataclass(frozen=True)
class Turn:
    """A turn in which the die sets off at an angle, and begins again after a rest if one is given.

    It is drawn on and on, so that what the turn has no room for is seen; `quiet` marks the ends of
    the mill's move, in which that hardly moves.
    """

    machine: MillAndDie
    start_deg: float
    way_deg: float
    work_deg: float
    quiet: bool = False
    again_after_deg: float | None = None

    def end(self, *, late: str, early: str, fits: str) -> str:
        """Say how it ends: strikes, late without that, early, or as it fits the mill."""
        if 2 * self.way_deg + self.work_deg > DEG_PER_TURN + ROUNDING:
            return _NO_ROOM
        over = 2 * (self.start_deg + self.way_deg) + self.work_deg
        over -= DEG_PER_TURN + self.machine.mill_angle_deg  # it may end as late as it begins early
        if abs(over) < ROUNDING:
            return fits
        if over < 0:
            return early
        die = die_from(self.machine, self.start_deg, self.way_deg, self.work_deg)
        strike = find_strike(self.machine, die)
        return f"{late} {strike.said}" if strike else late

    def show(self, line: str) -> Shown:
        """Draw it, and the mill above it."""
        machine, frame = self.machine, Frame()
        low = min(max(self.start_deg - 15, -90), 0)
        high = DEG_PER_TURN + machine.mill_angle_deg + 15
        scale = (_RIGHT - _LEFT) / (high - low)

        def x(angle_deg: float) -> float:
            return _LEFT + (min(max(angle_deg, low), high) - low) * scale

        for begin in (-DEG_PER_TURN, 0, DEG_PER_TURN):
            self._draw_mill(frame, begin, x)
        self._draw_die(frame, low, high, x)
        frame.text(6, 27, "mill", MILL_TEXT)
        frame.text(6, _DIE_TOP + 4, "die", DIE_TEXT)
        for angle in (0, machine.mill_angle_deg, DEG_PER_TURN):
            frame.line([(x(angle), _MILL_TOP), (x(angle), _AXIS + 4)], GREY, 1, "2 3")
            frame.text(x(angle), _AXIS + 18, f"{angle:g} deg", anchor="middle")
        frame.line([(_LEFT, _AXIS), (_RIGHT, _AXIS)], GREY, 1)
        frame.text(_RIGHT, _AXIS + 18, "next turn", GREY, "end")
        return frame.show(line)

    def depth_mm(self, angles_deg: Floats) -> Floats:
        """Return how deep the die is, in this turn and after its rest in the next one."""
        cycle = 2 * self.way_deg + self.work_deg
        starts = [self.start_deg]
        if self.again_after_deg is not None:
            starts.append(self.start_deg + cycle + self.again_after_deg)
        law, share = LAWS["cycloidal"], np.zeros_like(angles_deg)
        for start in starts:
            down = np.clip((angles_deg - start) / self.way_deg, 0, 1)
            up = np.clip((angles_deg - start - self.way_deg - self.work_deg) / self.way_deg, 0, 1)
            share += np.asarray(law(down)) - np.asarray(law(up))
        return self.machine.stroke_mm * share

    def _draw_mill(self, frame: Frame, begin: float, x: Callable[[float], float]) -> None:
        end, height = begin + self.machine.mill_angle_deg, _MILL_BOTTOM - _MILL_TOP
        quiet = self.machine.quiet_deg if self.quiet else 0
        left, right, inner = x(begin), x(end), x(begin + quiet)
        if right <= left:
            return
        frame.box(left, _MILL_TOP, right - left, height, PALEST_MILL)
        frame.box(inner, _MILL_TOP, x(end - quiet) - inner, height, PALE_MILL)
        frame.line([(left, _MILL_BOTTOM), (right, _MILL_BOTTOM)], MILL)
        if right - left > _ROOM_FOR_WORD:
            frame.text((left + right) / 2, 27, "moves", MILL_TEXT, "middle")

    def _draw_die(self, frame: Frame, low: float, high: float, x: Callable[[float], float]) -> None:
        machine = self.machine
        scale = (_DIE_BOTTOM - _DIE_TOP) / machine.stroke_mm
        angles = np.linspace(low, high, _SAMPLES)
        depths = zip(angles, self.depth_mm(angles), strict=True)
        points = [(x(angle), _DIE_TOP + depth * scale) for angle, depth in depths]
        frame.area([(_LEFT, _DIE_TOP), *points, (_RIGHT, _DIE_TOP)], PALE_DIE)
        for first, last in self._too_deep(np.linspace(low, high, _FINE)):
            frame.alarm(x(first), _DIE_TOP, x(last) - x(first), _DIE_BOTTOM - _DIE_TOP)
        frame.line(points, DIE)
        rim = _DIE_TOP + machine.wait_mm * scale
        frame.line([(_LEFT, rim), (_RIGHT, rim)], MILL, 1, "6 4")
        frame.text(6, rim + 4, "rim", MILL_TEXT)

    def _too_deep(self, angles_deg: Floats) -> list[tuple[float, float]]:
        """Return from where to where it is too deep while the mill is on its way."""
        rule, offset = self.machine.rule, np.asarray(self.machine.mill.offset_mm(angles_deg))
        deep = self.depth_mm(angles_deg) > rule.when.limit_mm + ROUNDING
        broken = np.r_[False, deep & (offset > rule.only_while.limit_mm + ROUNDING), False]
        edges = np.flatnonzero(np.diff(broken.astype(int))).reshape(-1, 2)
        return [(float(angles_deg[a]), float(angles_deg[b - 1])) for a, b in edges]
