"""Where a number comes from: the formula, and the same with the numbers put in."""

import math

from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import (
    DEG_PER_TURN,
    MM_PER_M,
    indexing_time,
    peak_acceleration,
    peak_velocity,
)
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.quantities import in_decimals, rate_as_text

_SAME = 1e-6
_PLACES = 4  # of an angle in deg: a search leaves less


def of_peak(diagram: TimingDiagram, name: str) -> str:
    """Return how the peak acceleration of a motion comes about, in a few sentences."""
    motion, peak = diagram[name], diagram.peak_acceleration(name)
    if not motion.moves:
        return f"The {name} stands all the turn."
    if math.isinf(peak):
        return f"The velocity of the {name} jumps: no acceleration is large enough for that."
    hardest = max(motion.moves, key=lambda move: _peak(diagram, move))
    alone = _peak(diagram, hardest)
    if not math.isclose(alone, peak, rel_tol=_SAME):
        return (
            f"The peak of the whole motion is {peak:.4g} m/s², from its curve: it does not rest "
            "between all its moves, so that no factor of a law gives it."
        )
    law, time_s = as_law(hardest.law), _time_s(diagram, hardest)
    way = abs(hardest.change_mm) / MM_PER_M
    return (
        f"The {hardest.kind} from {start_deg(hardest):g} deg by the law {law.name}: "
        f"a = C_a · h / t² = {law.Ca:.4f} · {way:g} m / ({time_s:.5g} s)² = "
        f"{in_decimals(alone, 4)} m/s², where t = B / 360° · 3600 s / N = "
        f"{hardest.angle_deg:.5g}° / 360° · 3600 s / {diagram.rate_per_hour:g} = {time_s:.5g} s."
    )


def of_velocity(diagram: TimingDiagram, name: str) -> str:
    """Return how the peak velocity of a motion comes about."""
    motion = diagram[name]
    if not motion.moves:
        return f"The {name} stands all the turn."
    fastest = max(
        motion.moves,
        key=lambda move: peak_velocity(*_asked(diagram, move)),
    )
    law, time_s = as_law(fastest.law), _time_s(diagram, fastest)
    way = abs(fastest.change_mm) / MM_PER_M
    return (
        f"The {fastest.kind} from {start_deg(fastest):g} deg: v = C_v · h / t = "
        f"{law.Cv:.4f} · {way:g} m / {time_s:.5g} s = {in_decimals(law.Cv * way / time_s, 4)} m/s."
    )


def of_rate(rate_per_hour: float, today: float, then: float) -> str:
    """Return how the rate comes about at which a largest peak is met again."""
    if not 0 < then < math.inf:
        return f"No peak tells a rate here: it stays at {rate_per_hour:g} pieces/h."
    if math.isinf(today):
        return "Today's peak is infinite: no rate reaches it."
    faster = rate_per_hour * math.sqrt(today / then)
    return (
        f"A peak grows with the square of the rate: N · √(a₁ / a₂) = {rate_per_hour:g} · "
        f"√({in_decimals(today, 4)} / {in_decimals(then, 4)}) = {rate_as_text(faster)} "
        "pieces/h."
    )


def start_deg(begins: Motion | Segment) -> float:
    """Return in deg where a motion or a move begins in the turn, but for what a search leaves."""
    angle = begins.start_deg if isinstance(begins, Motion) else begins.from_deg
    return round(angle % DEG_PER_TURN, _PLACES) % DEG_PER_TURN


def _peak(diagram: TimingDiagram, move: Segment) -> float:
    return float(peak_acceleration(*_asked(diagram, move)))


def _asked(diagram: TimingDiagram, move: Segment) -> tuple[float, float, float, MotionLaw]:
    """Return stroke, angle, rate and law of a move, as the kinematics ask for them."""
    return abs(move.change_mm), move.angle_deg, diagram.rate_per_hour, as_law(move.law)


def _time_s(diagram: TimingDiagram, move: Segment) -> float:
    return float(indexing_time(move.angle_deg, diagram.rate_per_hour))
