"""The best diagram of a whole machine: all starts, indexing angles and laws at once.

`widest_move` widens one part after the other, and the order decides. Here no order is chosen: what
is asked is a mixed-integer linear program (see `whole.move_program`), and its answer is the best
of all diagrams whose moves go from rest to rest by the given laws. What other motions could do,
`least_peak` says.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np

from cammotion.arguments import checked
from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.limits.faults import Asked, find_faults
from cammotion.machine.arcs import Arc
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment, with_dwells
from cammotion.quantities import InputError, Quantity, WrongAnswerError
from cammotion.rules.checks import find_violations
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.conditions import Condition
from cammotion.whole.asked_of_all import Task, read_task, weighted_peak
from cammotion.whole.asked_of_moves import Laws, Ranges, read_laws, read_ranges
from cammotion.whole.crossings import Span, fixed_spans, spans
from cammotion.whole.move_program import Apart, Mover, Placed, place
from cammotion.whole.parts import Part

_SECONDS = Quantity("time", "s", example=20)
_ROUNDING_DEG = 1e-6  # so near to where a part has to stand a move ends there
_SHARE = 1e-5  # of a peak, that may be rounding
_DIGITS = 4


@dataclass(frozen=True, repr=False)
class Optimised:
    """The best diagram with moves by given laws: `design`, in place of `diagram`.

    `reached` is its largest peak, each times its weight, in `unit`; `bound` is what no other
    diagram of such moves can be below, and nearly the same unless the time was too short.
    """

    diagram: TimingDiagram
    bound: float
    design: TimingDiagram
    weights: Mapping[str, float]
    unit: str = "m/s²"

    @property
    def reached(self) -> float:
        """The largest weighted peak of the design."""
        return weighted_peak(self.design, self.weights)

    @property
    def peaks(self) -> dict[str, float]:
        """The peak acceleration of each free part in m/s2."""
        return {name: self.design.peak_acceleration(name) for name in self.weights}

    def __repr__(self) -> str:
        """Say what is reached, where it was before, and each move."""
        before = weighted_peak(self.diagram, self.weights)
        lines = [f"{self.reached:.{_DIGITS}f} {self.unit} (before: {before:.{_DIGITS}f})"]
        for name, peak in self.peaks.items():
            lines.append(f"{name}: {peak:.{_DIGITS}f} m/s²")
            lines += [
                f"  {move.kind} over {move.angle_deg:.3f} deg "
                f"from {move.from_deg % DEG_PER_TURN:.3f} deg, {as_law(move.law).name}"
                for move in self.design[name].moves
            ]
        return "\n".join(lines)


@checked
def optimise(  # noqa: PLR0913 - all but two are given by name
    diagram: TimingDiagram,
    rules: ClearanceRule | Iterable[ClearanceRule],
    *,
    still: Mapping[str, Iterable[Arc]],
    laws: Laws | Mapping[str, Laws] | None = None,
    starts_deg: Mapping[str, Ranges] | None = None,
    angles_deg: Mapping[str, Ranges] | None = None,
    weights: Mapping[str, float] | None = None,
    at_most: Mapping[str, float] | None = None,
    unit: str = "m/s²",
    seconds: float = 20.0,
) -> Optimised:
    """Return the diagram with the least largest peak, of all starts, angles and laws of its moves.

    The parts named in `still` are free: each of their moves, rises and returns each with their own
    start and indexing angle. Over the `still` arcs, pairs of cam angles in deg, a part stands where
    it does in the diagram; strokes and the order of the moves stay; all rules that a free part has
    a share in are kept, exactly. All other parts stay as they are. `laws` may be a list for all,
    or one for each part by its name, of which each move gets the best; without it each keeps its
    own. `starts_deg` and `angles_deg` give for a part a range, or None, for each of its moves.

    The largest of the peak accelerations is made small, each times its weight (1 if none is given;
    with masses in kg it is a force, and `unit` is "N"); then with it held the next one, and so on.
    With `at_most` no peak of a part is above a limit in m/s2.

    The answer is the best there is, not only the best of some tries, as far as the solver HiGHS can
    be trusted: it searches the program through, to a ten-thousandth (where the `seconds` are
    enough; `bound` tells). What it finds is checked before it is returned by `find_violations` and
    by its curves; raises WrongAnswerError if that fails.
    Raises InputError for what is out of range, for laws that do not rest at both ends, for an arc
    over which a part does not stand, and where no starts and angles keep the rules.

    >>> import cammotion as cm
    >>> machine = cm.TimingDiagram([cm.EXAMPLE.mill, cm.EXAMPLE.die], rate_per_hour=2000)
    >>> rule = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 0.65))
    >>> optimise(machine, rule, still={"mill": [(205, 305)], "die": [(205, 305)]})
    0.9429 m/s² (before: 4.1542)
    mill: 0.9429 m/s²
      rise over 163.267 deg from 353.366 deg, cycloidal
    die: 0.9429 m/s²
      rise over 115.447 deg from 89.553 deg, cycloidal
      return over 115.447 deg from 305.000 deg, cycloidal
    """
    task = read_task(diagram, rules, still=still, weights=weights, at_most=at_most)
    found = _best(task, laws, (starts_deg, angles_deg), _SECONDS.number(seconds))
    if found is None:
        raise InputError(
            "No starts and angles of these moves keep all of this: allow larger ranges or peaks, "
            "give shorter still arcs, or weaker rules."
        )
    design, bound = found
    answer = Optimised(diagram, bound, design, task.weights, unit)
    _check(task, answer)
    return answer


def best_moves(task: Task, laws: Laws, seconds: float) -> TimingDiagram | None:
    """Return the diagram with the best moves by these laws; None if none keep the rules."""
    try:
        found = _best(task, laws, (None, None), seconds)
    except InputError:  # for a part that cannot be placed at will
        return None
    return found[0] if found else None


def _best(
    task: Task, laws: Any, ranges: tuple[Any, Any], seconds: float
) -> tuple[TimingDiagram, float] | None:
    """Return the best diagram and its bound, which nothing has checked yet."""
    chosen = read_laws(task, laws)
    starts, angles = (
        read_ranges(task, what, given)
        for what, given in zip(("start", "indexing angle"), ranges, strict=True)
    )
    movers = [
        _mover(part, own, starts[part.motion.name], angles[part.motion.name])
        for part, own in zip(task.parts, chosen, strict=True)
    ]
    found = place(movers, list(_apart(task, chosen)), seconds)
    if found is None:
        return None
    design = task.diagram
    for part, moves in zip(task.parts, found[0], strict=True):
        if moves:
            design = design.with_motion(_built(part, moves))
    return design, task.in_metres(1 / found[1] ** 2) if found[1] else 0.0


def _mover(
    part: Part,
    laws: list[list[MotionLaw]],
    starts: list[tuple[float, float] | None],
    angles: list[tuple[float, float] | None],
) -> Mover:
    """Return the ranges of a part's moves: those given, within what its still arcs leave."""
    moves = part.motion.moves
    low = [move.from_deg - DEG_PER_TURN for move in moves]
    high = [move.from_deg + DEG_PER_TURN for move in moves]
    ends = [move.to_deg + DEG_PER_TURN for move in moves]
    for number, move in enumerate(moves):
        on = (number + 1) % len(moves)
        turn = 0.0 if on else float(DEG_PER_TURN)
        for start, end in part.still:
            turned = -((start - move.to_deg + _ROUNDING_DEG) // DEG_PER_TURN) * DEG_PER_TURN
            if end + turned <= moves[on].from_deg + turn + _ROUNDING_DEG:
                ends[number] = min(ends[number], start + turned)
                low[on] = max(low[on], end + turned - turn)
    for number, given in enumerate(starts):
        if given:
            turns = round((moves[number].from_deg - sum(given) / 2) / DEG_PER_TURN) * DEG_PER_TURN
            low[number] = max(low[number], given[0] + turns)
            high[number] = min(high[number], given[1] + turns)
        if low[number] > high[number]:
            raise InputError(
                f"The start of a move of the {part.motion.name} would lie in a still arc: give a "
                "range outside of it."
            )
    strokes = [abs(move.change_mm) for move in moves]
    return Mover(
        tuple(map(tuple, laws)),
        tuple(
            tuple(part.weight * law.Ca * stroke for law in own)
            for own, stroke in zip(laws, strokes, strict=True)
        ),
        tuple(
            tuple((law.Ca * stroke / part.cap) ** 0.5 for law in own)
            for own, stroke in zip(laws, strokes, strict=True)
        ),
        tuple(zip(low, high, strict=True)),
        tuple(given or (0.0, float(DEG_PER_TURN)) for given in angles),
        tuple(ends),
    )


def _apart(task: Task, laws: Sequence[list[list[MotionLaw]]]) -> Iterator[Apart]:
    """Yield all arcs that may not overlap: where a half holds, and where the other does not."""
    names = [part.motion.name for part in task.parts]

    def held(condition: Condition) -> tuple[int | None, list[Span]]:
        motion = task.diagram[condition.motion]
        if condition.motion in names and motion.moves:
            part = names.index(condition.motion)
            return part, spans(motion, laws[part], condition)
        return None, fixed_spans(motion, condition)

    for rule in task.rules:
        (one, these), (other, those) = held(rule.when), held(rule.only_while.opposite)
        yield from (Apart((one, other), pair) for pair in product(these, those))


def _built(part: Part, placed: Sequence[Placed]) -> Motion:
    """Return the motion with its moves where they were found, beside its still arcs exactly."""
    known = [end for arc in part.still for end in arc]
    ends = [
        (_snap(one.start_deg, known), _snap(one.start_deg + one.angle_deg, known)) for one in placed
    ]
    following = [*(start for start, _ in ends[1:]), ends[0][0] + DEG_PER_TURN]
    moves = [
        Segment(
            from_deg=start,
            to_deg=on if abs(on - end) < _ROUNDING_DEG else end,
            from_mm=move.from_mm,
            to_mm=move.to_mm,
            law=one.law,
        )
        for move, one, (start, end), on in zip(
            part.motion.moves, placed, ends, following, strict=True
        )
    ]
    return Motion(part.motion.name, tuple(with_dwells(moves, following)), part.motion.stops)


def _snap(angle_deg: float, known: Sequence[float]) -> float:
    """Return what an angle is but for rounding: one of those known, in its turn."""
    for one in known:
        turned = one + round((angle_deg - one) / DEG_PER_TURN) * DEG_PER_TURN
        if abs(turned - angle_deg) < _ROUNDING_DEG:
            return turned
    return angle_deg


def _check(task: Task, answer: Optimised) -> None:
    """Raise WrongAnswerError unless the design keeps what it has to and has the peak promised."""
    faults = [str(one) for one in find_violations(answer.design, task.rules)] if task.rules else []
    for part in task.parts:
        new = answer.design[part.motion.name]
        before = answer.design.with_motion(part.motion)
        asked = Asked((), part.still, (-np.inf, np.inf), np.inf)
        faults += find_faults(before, new, asked)
        if task.too_hard(part, answer.design):
            faults.append(f"the peak of the {new.name} is above its limit")
    if answer.reached < answer.bound * (1 - _SHARE):
        faults.append(f"it reaches {answer.reached:g}, less than the bound {answer.bound:g}")
    if faults:
        raise WrongAnswerError("optimise", "; ".join(faults))
