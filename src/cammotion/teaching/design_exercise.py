"""Open exercises: a design is asked for, and judged by what it has to keep."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from cammotion.exchange.law_text import is_same_law
from cammotion.laws.catalogue import LAWS, as_law
from cammotion.limits.faults import Asked, find_faults
from cammotion.limits.widest import WidestMove
from cammotion.machine.arcs import Arc, arcs, intersect, unwrap
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import arcs_of
from cammotion.own import Machine
from cammotion.quantities import as_text
from cammotion.rules.checks import find_violations
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.conditions import within
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import Exercise, Verdict
from cammotion.teaching.reading import OddAnswerError
from cammotion.teaching.reasons import short_name
from cammotion.whole.least_peak import least_peak
from cammotion.whole.optimise import Optimised, optimise

_GAP, _SECONDS = 0.1, 5.0  # of the bound, which need not be close to tell how far a design is
_SAME = 1e-6  # mm, and a share of a peak
_DECIMALS = 1000  # of a limit in mm that a question tells
_UNITS = {"peak_acceleration": "m/s²", "peak_jerk": "m/s³"}
_FAR = 1e12  # m/s3: a jerk beyond it is a jump
_TEXT = (
    "This is no design but a text. If it is a table, like that of the lesson, "
    "cm.machine_from_text makes a machine of it, and cm.read_machine of a file. Give {}."
)


@dataclass(frozen=True)
class Requirement:
    """What a design has to keep: in words, and `fault` says "" or what is measured instead.

    `reason` is what is said where it is not kept.
    """

    reason: str
    fault: Callable[[TimingDiagram, MillAndDie], str]


@dataclass(frozen=True, kw_only=True)
class DesignExercise(Exercise):
    """A design of mill and die with a largest peak of at most `limit` in m/s2.

    With a `law` all moves have that law; with a `jerk_limit`, in m/s3, the jerk is at most that.
    The answer is a timing diagram, or a Machine; `answer` makes one that is right. In a contest the
    class page shows who came nearest to the bound.
    """

    answer: Callable[[MillAndDie], TimingDiagram]
    limit: Callable[[MillAndDie], float]
    law: str = ""
    jerk_limit: Callable[[MillAndDie], float] | None = None
    is_contest: bool = False

    @property
    def wanted(self) -> str:
        """What kind of answer is asked for, in words."""
        return "a TimingDiagram of mill and die, or a Machine"

    def solution(self, machine: MillAndDie) -> TimingDiagram:
        """Return a design that is right."""
        return self.answer(machine)

    def judge(self, answer: Any, machine: MillAndDie) -> Verdict:
        """Judge a design: what it keeps, what not, and how far from the bound it is."""
        verdict = super().judge(answer, machine)
        design = _design(answer)
        if verdict.state == "open" or design is None:
            return verdict
        if verdict.state == "right":
            return Verdict("right", f"{self.right} {said_of(design, machine)}")
        first = next((reason for reason in self.faults if reason in verdict.text), None)
        return Verdict("wrong", verdict.text, short_name(first)) if first else verdict

    def find_fault(self, answer: Any, machine: MillAndDie) -> str:
        """Return which requirements a design does not meet; "" if it meets all."""
        design = _design(answer)
        if isinstance(answer, str | bytes):
            raise OddAnswerError(_TEXT.format(self.wanted))
        if design is None:
            raise OddAnswerError(
                f"This is no design (it is of type {type(answer).__name__}). Give {self.wanted}."
            )
        if wrong := _PARTS.fault(design, machine):
            return f"{_PARTS.reason} {wrong}"
        found = [(one, one.fault(design, machine)) for one in self.requirements]
        unmet = [f"{one.reason} {wrong}" for one, wrong in found if wrong]
        if not unmet:
            return ""
        met = len(found) - len(unmet)
        return " ".join([*unmet, f"Of the {len(found)} requirements {met} are met."])

    @property
    def requirements(self) -> tuple[Requirement, ...]:
        """What a design has to keep, in the order in which it is told."""
        too_hard = Requirement(
            "The largest peak acceleration is above what is asked for.",
            lambda design, machine: _above(design, "peak_acceleration", self.limit(machine)),
        )
        asked = *_ALWAYS, *([_of_law(self.law)] if self.law else []), too_hard
        if self.jerk_limit is None:
            return asked
        jerk_limit = self.jerk_limit
        too_sharp = Requirement(
            "The largest jerk is above what is asked for.",
            lambda design, machine: _above(design, "peak_jerk", jerk_limit(machine)),
        )
        return (*asked, too_sharp)

    @property
    def faults(self) -> tuple[str, ...]:
        """The reasons of all requirements."""
        return (_PARTS.reason, *(one.reason for one in self.requirements))

    def score(self, answer: Any, machine: MillAndDie) -> float | None:
        """Return how many times the bound a right design reaches; None for any other answer."""
        design = _design(answer)
        if design is None or self.judge(answer, machine).state != "right":
            return None
        return largest_peak(design) / bound_of(machine)


def balanced(machine: MillAndDie, *laws: str) -> TimingDiagram:
    """Return the best diagram of mill and die by given laws; without any, by those they have."""
    return _balanced(machine.diagram, clearance_rule(machine), _work(machine), laws)


def bound_of(machine: MillAndDie) -> float:
    """Return what no motions of mill and die can be below, in m/s2, within a tenth.

    The die stays within its stroke, and both stand while it works.
    """
    return _bound(machine.diagram, clearance_rule(machine), _work(machine), machine.stroke_mm)


# Each by all that it depends on: many machines differ in other numbers alone.
@lru_cache(maxsize=200)
def _balanced(
    diagram: TimingDiagram, rule: ClearanceRule, work: Arc, laws: tuple[str, ...]
) -> TimingDiagram:
    return optimise(diagram, rule, still=_both(work), laws=laws or None).design


@lru_cache(maxsize=200)
def _bound(diagram: TimingDiagram, rule: ClearanceRule, work: Arc, stroke_mm: float) -> float:
    travel = {"die": (0.0, stroke_mm)}
    found = least_peak(
        diagram, rule, still=_both(work), travel_mm=travel, gap=_GAP, seconds=_SECONDS
    )
    return found.bound


def clearance_rule(machine: MillAndDie) -> ClearanceRule:
    """Return the rule of mill and die with a limit of few digits, which it is a little wider by."""
    near = machine.rule.only_while.limit_mm
    wider = math.ceil(near * _DECIMALS) / _DECIMALS
    return ClearanceRule(machine.rule.when, only_while=within("mill", wider))


def said_of(design: TimingDiagram, machine: MillAndDie) -> str:
    """Say how far a design is from the bound."""
    reached, bound = largest_peak(design), bound_of(machine)
    return (
        f"It reaches {reached:.4g} m/s². No motions of these parts can have less than "
        f"{np.floor(bound * 1000) / 1000:.3f} m/s², so that it is at most "
        f"{math.ceil(100 * (reached / bound - 1))} % above the best there could be."
    )


def _work(machine: MillAndDie) -> Arc:
    """Return the arc over which both stand."""
    return machine.down_deg, machine.down_deg + machine.work_deg


def _both(work: Arc) -> dict[str, list[Arc]]:
    return {"mill": [work], "die": [work]}


def _design(answer: Any) -> TimingDiagram | None:
    """Return the design that is given: itself, in a machine, or in what a solver has found."""
    if isinstance(answer, Optimised):
        return answer.design
    if isinstance(answer, Machine | MillAndDie | WidestMove):
        return answer.diagram
    return answer if isinstance(answer, TimingDiagram) else None


def largest_jerk(design: TimingDiagram) -> float:
    """Return the largest peak jerk of a design in m/s3."""
    return max(design.peak_jerk(name) for name in design.names)


def largest_peak(design: TimingDiagram) -> float:
    """Return the largest peak acceleration of a design in m/s2."""
    return max(design.peak_acceleration(name) for name in design.names)


def _parts(design: TimingDiagram, _: MillAndDie) -> str:
    names = ", ".join(design.names)
    return "" if {*design.names} == {"mill", "die"} else f"It has {names[:60]}."


def _rate(design: TimingDiagram, machine: MillAndDie) -> str:
    rate = design.rate_per_hour
    same = abs(rate / machine.rate_per_hour - 1) <= _SAME
    return "" if same else f"It is {rate:g} pieces per hour."


def _pitch(design: TimingDiagram, machine: MillAndDie) -> str:
    mill = design["mill"]
    same = mill.stops == machine.stops and abs(mill.pitch_mm - machine.pitch_mm) <= _SAME
    return "" if same else f"It goes {mill.pitch_mm:g} mm and has {mill.stops or 'no'} stops."


def _stroke(design: TimingDiagram, machine: MillAndDie) -> str:
    low, high = design["die"].range_mm
    same = abs(low) <= _SAME and abs(high - machine.stroke_mm) <= _SAME
    return "" if same else f"It goes from {low:g} to {high:g} mm."


def _stands(design: TimingDiagram, machine: MillAndDie) -> str:
    before = machine.diagram
    moved: list[str] = []
    where: list[str] = []
    for name, standing in _both(_work(machine)).items():
        asked = Asked((), tuple(standing), (-np.inf, np.inf), np.inf)
        old, new = before[name], design[name]
        if old.is_indexing != new.is_indexing:
            moved.append(name)
            continue
        if new.is_indexing:  # its stops are alike, whichever it begins with
            off_mm = float(old.position_mm(standing[0][0]) - new.position_mm(standing[0][0]))
            new = new.shifted(-DEG_PER_TURN * round(off_mm / new.pitch_mm))
        if any(find_faults(before, new, asked)):
            moved.append(name)
            where += [_where(old, new, arc) for arc in standing]
    names = " and the ".join(moved)
    told = [f"The {names} {'do' if len(moved) > 1 else 'does'} not.", *filter(None, where)]
    return " ".join(told) if moved else ""


def _where(old: Motion, new: Motion, arc: Arc) -> str:
    """Say where on an arc a motion moves, or stands elsewhere than the old one; "" if it does not.

    >>> from cammotion.teaching.example import EXAMPLE
    >>> _where(EXAMPLE.die, EXAMPLE.die.shifted(3), (205, 305))
    'The die moves from 205 to 208 degrees.'
    """
    moves = unwrap(intersect(arcs([arc]), arcs_of(new.moves)))
    moved = [(start, end) for start, end in moves if end - start > _SAME]
    if moved:
        told = " and ".join(f"from {start:.6g} to {end:.6g}" for start, end in moved)
        return f"The {new.name} moves {told} degrees."
    place = float(new.position_mm(arc[0]))
    is_there = abs(place - float(old.position_mm(arc[0]))) <= _SAME
    return "" if is_there else f"The {new.name} stands at {place:.6g} mm."


def _rule(design: TimingDiagram, machine: MillAndDie) -> str:
    found = find_violations(design, clearance_rule(machine))
    said = str(found[0]) if found else ""
    return f"{said[:1].upper()}{said[1:]}." if said else ""


def _of_law(name: str) -> Requirement:
    def other(design: TimingDiagram, _: MillAndDie) -> str:
        moves = ((each.name, move) for each in design.motions for move in each.moves)
        others = (one for one in moves if not is_same_law(as_law(one[1].law), LAWS[name]))
        return next((f"The {move.kind} of the {whose} has another." for whose, move in others), "")

    return Requirement(f"Each move has to have the law '{name}'.", other)


def _smooth(design: TimingDiagram, _: MillAndDie) -> str:
    jumps = [name for name in design.names if not design.peak_jerk(name) < _FAR]
    return f"It does so in the {' and the '.join(jumps)}." if jumps else ""


def _above(design: TimingDiagram, peak: str, limit: float) -> str:
    """Say whose peak, of acceleration or jerk, is the largest of a design, "" within the limit."""
    peaks = {name: getattr(design, peak)(name) for name in design.names}
    whose = max(peaks, key=peaks.__getitem__)
    told = f"{as_text(peaks[whose], '.4g')} {_UNITS[peak]}"
    return "" if peaks[whose] <= limit * (1 + _SAME) else f"It is {told}, that of the {whose}."


_PARTS = Requirement("The design has to have two motions, 'mill' and 'die'.", _parts)
_ALWAYS = (
    Requirement("The machine rate is not that of the question.", _rate),
    Requirement("The mill has to move one pitch on, with as many stops as before.", _pitch),
    Requirement("The die has to go from 0 mm to its full stroke and back.", _stroke),
    Requirement("While the die works both have to stand where they stood.", _stands),
    Requirement("The clearance rule is broken.", _rule),
    Requirement("An acceleration jumps, so that the jerk has no bound.", _smooth),
)
