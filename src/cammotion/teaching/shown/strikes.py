"""Where the die runs into the mill, by the machine's own rule."""

from dataclasses import dataclass

from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.parts import dwell, motion, return_, rise
from cammotion.rules.checks import find_violations
from cammotion.teaching.example import MillAndDie

ROUNDING = 1e-6  # mm or deg, beneath which nothing is said of a difference


@dataclass(frozen=True)
class Strike:
    """The worst place at which the die is too deep while the mill is on its way."""

    depth_mm: float
    angle_deg: float
    touches: bool
    on_the_way_up: bool

    @property
    def said(self) -> str:
        """What happens, in words."""
        end = "it strikes." if self.touches else "there is less than the margin between them."
        where = f"{self.angle_deg:.4g} deg{' of the next turn' if self.on_the_way_up else ''}"
        return f"At {where}, while the mill moves, the die is {self.depth_mm:.1f} mm deep: {end}"


def find_strike(machine: MillAndDie, die: Motion) -> Strike | None:
    """Return where another motion of the die breaks the machine's rule worst, None if nowhere."""
    violations = find_violations(machine.diagram.with_motion(die), machine.rule)
    worst = max(
        violations, key=lambda found: (round(found.excess_mm, 6), found.angle_deg), default=None
    )
    if worst is None or worst.excess_mm < ROUNDING:
        return None
    depth, angle = machine.limit_mm + worst.excess_mm, worst.angle_deg % DEG_PER_TURN
    return Strike(
        depth, angle, depth > machine.wait_mm + ROUNDING, angle < machine.mill_angle_deg / 2
    )


def die_from(machine: MillAndDie, start_deg: float, way_deg: float, work_deg: float) -> Motion:
    """Return the die that sets off at an angle, with as many degrees for each way and its work."""
    rest = DEG_PER_TURN - 2 * way_deg - work_deg
    return motion(
        "die",
        rise(machine.stroke_mm, over_deg=way_deg),
        dwell(work_deg),
        return_(machine.stroke_mm, over_deg=way_deg),
        *([dwell(rest)] if rest > ROUNDING else []),
        start_deg=start_deg,
    )


def fits_turn(way_deg: float, work_deg: float) -> bool:
    """Tell whether both ways and the work find room in a turn."""
    return 2 * way_deg + work_deg < DEG_PER_TURN
