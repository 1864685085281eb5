"""Overlap: the widest move that two motions may make at the same time without a collision.

When a motion is made wider, every cam angle at which it meets a limit moves in proportion to its
indexing angle Bm. So a clearance rule can begin or cease to hold only at such Bm for which one of
these angles meets one at which another motion meets its own limit. These are tried, the widest
first; nothing is searched for in steps.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from cammotion.machine.arcs import ROUNDING_DEG
from cammotion.machine.clearance import Clearance, ClearanceRule, after, as_rules, find_violations
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.quantities import InputError, Quantity

_NARROW_DEG = 1e-4  # a move that takes no time, for all that a cam can do
_TOUCHING_MM = 1e-6


@dataclass(frozen=True)
class WidestMove:
    """The widest move of a motion that keeps every rule, and what stops it from being wider.

    `diagram` is the diagram with that move in it, `motion` the name of the motion and `angle_deg`
    its indexing angle Bm. `tight` is the clearance that is used up; it is None where nothing but
    the turn of 360 deg sets the bound.
    """

    diagram: TimingDiagram
    motion: str
    angle_deg: float
    tight: Clearance | None

    @property
    def start_deg(self) -> float:
        """The cam angle at which the move begins, 0 to 360."""
        return self.diagram[self.motion].moves[0].from_deg % DEG_PER_TURN

    @property
    def peak_acceleration(self) -> float:
        """The peak acceleration of the move in m/s2."""
        return self.diagram.peak_acceleration(self.motion)


_Event = tuple[float, ClearanceRule, float]


def widest_move(
    diagram: TimingDiagram, motion: str, rules: ClearanceRule | Iterable[ClearanceRule]
) -> WidestMove:
    """Return the widest symmetric move of a motion that keeps every rule, whatever the laws.

    A motion with one rise and one return keeps the dwell between them where it is, and gets one
    angle for both; an indexing motion with one move keeps the middle of it. All other motions
    stay. Raises InputError if no move of the motion is free of collision, for a motion of another
    build, and as `find_violations` does.
    """
    given = as_rules(diagram, rules)
    frame = _Frame(diagram[motion])
    events = list(_events(diagram, frame, given))
    for angle in sorted({frame.widest, *(angle for angle, _, _ in events)}, reverse=True):
        wider = diagram.with_motion(frame.with_angle(angle))
        if not any(rule.violated_arcs(wider) for rule in given):
            meetings = [event for event in events if abs(event[0] - angle) <= ROUNDING_DEG]
            meetings.sort(key=lambda event: after(event[2], wider[motion].start_deg))
            return WidestMove(wider, motion, angle, _tight(wider, meetings))
    narrow = diagram.with_motion(frame.with_angle(_NARROW_DEG))
    collisions = "; ".join(map(str, find_violations(narrow, given)))
    raise InputError(
        f"No move of the {motion} is free of collision: however quickly it moves, {collisions}. "
        "Move its dwell, or give the other motion less of the turn."
    )


def with_angle(motion: Motion, angle_deg: float) -> Motion:
    """Return the motion with another indexing angle Bm, in deg, for all its moves.

    What stays in place is told at `widest_move`. Raises InputError for a motion of another build,
    and for an angle that the turn has no room for.

    >>> import cammotion as cm
    >>> mill = cm.indexing_motion("mill", cm.rise(100, over_deg=150), cm.dwell(210), stops=24)
    >>> with_angle(mill, 160).moves[0].to_deg
    155.0
    """
    frame = _Frame(motion)
    room = Quantity("indexing angle", "deg", example=frame.widest / 2, high=frame.widest)
    return frame.with_angle(room.number(angle_deg))


class _Frame:
    """A motion made wider or narrower about what stays in place.

    Place x of a move then stands at the cam angle anchor + (x - share) Bm, so every angle at which
    the motion meets a limit shifts in proportion to Bm.
    """

    def __init__(self, motion: Motion) -> None:
        self.motion, moves = motion, motion.moves
        if len(moves) != (1 if motion.is_indexing else 2):
            build = "one move" if motion.is_indexing else "one rise and one return"
            raise InputError(
                f"The motion {motion.name!r} has {len(moves)} moves, and only one with {build} can "
                "be widened symmetrically: give it that, or widen it by hand and look for "
                "violations."
            )
        first, last = moves[0], moves[-1]
        if motion.is_indexing:
            self.anchors = [(first, (first.from_deg + first.to_deg) / 2, 0.5)]
            self.widest = float(DEG_PER_TURN)
        else:
            self.anchors = [(first, first.to_deg, 1.0), (last, last.from_deg, 0.0)]
            self.widest = (DEG_PER_TURN - (last.from_deg - first.to_deg)) / 2

    def with_angle(self, angle: float) -> Motion:
        """Return the motion with the indexing angle Bm."""
        moves = [
            replace(move, from_deg=anchor - share * angle, to_deg=anchor + (1 - share) * angle)
            for move, anchor, share in self.anchors
        ]
        ends = [*(move.from_deg for move in moves[1:]), moves[0].from_deg + DEG_PER_TURN]
        return replace(self.motion, segments=tuple(_with_dwells(moves, ends)))

    def angles_at(self, limit_mm: float, angle_deg: float) -> Iterator[float]:
        """Yield every Bm with which the motion meets a limit at a cam angle."""
        meetings = [end for arc in self.motion.where_beyond(limit_mm) for end in arc]
        for move, anchor, share in self.anchors:
            ways = [(after(m, move.from_deg) - move.from_deg) / move.angle_deg for m in meetings]
            for place in {0.0, 1.0, *(way for way in ways if 0 < way < 1)} - {share}:
                for turn in (-1, 0, 1):
                    angle = (angle_deg + turn * DEG_PER_TURN - anchor % DEG_PER_TURN) / (
                        place - share
                    )
                    if _NARROW_DEG < angle < self.widest:
                        yield angle


def _tight(diagram: TimingDiagram, meetings: Iterable[_Event]) -> Clearance | None:
    """Return the first meeting at which both motions of its rule do stand at their limits."""
    for _, rule, where in meetings:
        rooms = [half.room_mm(diagram, where) for half in (rule.when, rule.only_while)]
        if max(map(abs, rooms)) < _TOUCHING_MM:
            return Clearance(rule, rooms[0], where)
    return None


def _with_dwells(moves: Iterable[Segment], ends: Iterable[float]) -> Iterator[Segment]:
    """Yield the moves, each with the dwell that follows it until the next one begins."""
    for move, end in zip(moves, ends, strict=True):
        yield move
        if end > move.to_deg:
            height = move.to_mm
            yield Segment(from_deg=move.to_deg, to_deg=end, from_mm=height, to_mm=height)


def _events(
    diagram: TimingDiagram, frame: _Frame, rules: Iterable[ClearanceRule]
) -> Iterator[_Event]:
    """Yield each Bm at which a rule can begin or cease to hold, with the rule and the cam angle.

    There the widened motion meets its limit at the same angle as the other motion meets its own.
    Between two neighbours of these Bm nothing changes.
    """
    for rule in rules:
        for own, other in ((rule.when, rule.only_while), (rule.only_while, rule.when)):
            if own.motion == frame.motion.name:
                for meeting in {end for arc in other.arcs(diagram) for end in arc}:
                    for angle in frame.angles_at(own.limit_mm, meeting):
                        yield angle, rule, meeting
