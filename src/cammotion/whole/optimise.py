"""The best diagram of a whole machine: all starts, indexing angles and laws at once.

`widest_move` widens one part after the other, and the order decides. Here no order is chosen: what
is asked is a mixed-integer linear program (see `whole.move_program`), and its answer is the best
of all diagrams whose moves go from rest to rest by the given laws, each still arc in its dwell of
today. What other motions could do, `least_peak` says. The least torque on the camshaft is sought by
`whole.torque_search`.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from cammotion.arguments import checked
from cammotion.drive.camshaft import LOADED, Camshaft
from cammotion.laws.catalogue import as_law
from cammotion.limits.standing import arcs_by_name
from cammotion.machine.arcs import Arc
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.segments import Segment
from cammotion.quantities import (
    InputError,
    Quantity,
    WrongAnswerError,
    in_decimals,
    one_of,
    outward,
)
from cammotion.rules.rule import Rule
from cammotion.whole.asked_of_all import Task, faults_of, read_task, weighted_peak
from cammotion.whole.asked_of_moves import Laws, Ranges
from cammotion.whole.movers import built, read_moves, today
from cammotion.whole.torque_search import least_torque, peak_torque
from cammotion.whole.wide_moves import Found, place, place_as_today

_SECONDS = Quantity("time", "s", example=20)
_SHARE = 1e-5  # of a peak, that may be rounding
_SEARCHED = 1e-3  # of a peak: a bound as near as that is the end of a search
_UNITS = {"peak": "m/s²", "force": "N", "torque": "N m"}


@dataclass(frozen=True, repr=False)
class Optimised:
    """The best diagram with moves by given laws: `design`, in place of `diagram`.

    `reached` is its largest peak, each times its weight, in `unit`; `bound` is what no other
    diagram of such moves can be below, each still arc being in its dwell of today, and nearly the
    same unless the time was too short; 0 if none is known.

    With a `shaft` whose torque was made small, `reached` is the largest torque on it. Then `bound`
    is 0, for none is known, and `tried` has what was reached from each start, the least first.
    """

    diagram: TimingDiagram
    bound: float
    design: TimingDiagram
    weights: Mapping[str, float]
    unit: str = "m/s²"
    shaft: Camshaft | None = None
    tried: tuple[float, ...] = ()

    @property
    def reached(self) -> float:
        """The largest weighted peak of the design, or the largest torque on the shaft."""
        return self._largest(self.design)

    @property
    def peaks(self) -> dict[str, float]:
        """The peak acceleration of each free part in m/s2."""
        return {name: self.design.peak_acceleration(name) for name in self.weights}

    @property
    def is_best(self) -> bool:
        """Whether the search was finished: no other largest peak is less by a thousandth."""
        return self.reached <= self.bound * (1 + _SEARCHED)

    def __repr__(self) -> str:
        """Say what is reached, where it was before, and each move."""
        said = partial(in_decimals, decimals=4)
        lines = [f"{said(self.reached)} {self.unit} (before: {said(self._largest(self.diagram))})"]
        if self.tried:
            least, most = said(self.tried[0]), said(self.tried[-1])
            lines.append(
                f"the best of {len(self.tried)} starts, which led to {least} to {most} "
                f"{self.unit}; no bound is known for a torque"
            )
        elif not self.is_best:
            low, _ = outward(self.bound, self.reached)
            known = (
                f"no such moves have less than {low} {self.unit}; the time was too short to search "
                "them all through"
            )
            lines.append(known if self.bound else "no bound is known")
        for name, peak in self.peaks.items():
            lines.append(f"{name}: {said(peak)} m/s²")
            lines += [
                f"  {move.kind} over {move.angle_deg:.3f} deg "
                f"from {move.from_deg % DEG_PER_TURN:.3f} deg, {as_law(move.law).name}"
                for move in self.design[name].moves
            ]
        return "\n".join(lines)

    def _largest(self, diagram: TimingDiagram) -> float:
        if self.shaft is not None:
            return peak_torque(self.shaft, diagram)
        return weighted_peak(diagram, self.weights)


@checked
def optimise(  # noqa: PLR0913 - all but two are given by name
    diagram: TimingDiagram | Camshaft,
    rules: Rule | Iterable[Rule],
    *,
    still: Mapping[str, Iterable[Arc]],
    minimise: str = "peak",
    laws: Laws | Mapping[str, Laws] | None = None,
    starts_deg: Mapping[str, Ranges] | None = None,
    angles_deg: Mapping[str, Ranges] | None = None,
    weights: Mapping[str, float] | None = None,
    at_most: Mapping[str, float] | None = None,
    unit: str | None = None,
    seconds: float = 20.0,
) -> Optimised:
    """Return the diagram with the least largest peak, of all starts, angles and laws of its moves.

    The parts named in `still` are free: each of their moves, rises and returns each with their own
    start and indexing angle. Over the `still` arcs, pairs of cam angles in deg, a part stands where
    it does in the diagram; strokes and the order of the moves stay, and so does the dwell in which
    a still arc is: another one at the same height is not tried in its place. A turret need not
    stand at a stop, but may at a pause between two. All rules that a free part has a share in are
    kept, exactly. All other parts stay as they are. `laws` may be a list for all, or one for each
    part by its name, of which each move gets the best; without it each keeps its own. `starts_deg`
    and `angles_deg` give for a part a range, or None, for each of its moves.

    The largest of the peak accelerations is made small, each times its weight (1 if none is given),
    in `unit`; then, with its part held there and in the order of the moves that was found for it,
    the largest of the others, and so on; and last, of
    each part, those of its other moves; who passes whom stays as it is for the first of them. With
    `at_most` no peak of a part is above a limit in m/s2.
    With a Camshaft in place of the diagram, `minimise` may be "force", mass times acceleration:
    then the weights are the masses of its loads, one for each free part.

    It may also be "torque", the largest one on the shaft over the turn, with springs, weights,
    friction, the forces of the process, and the loads of parts that are not free. Masses that slow
    down pay for those that speed up, and so there is no program that finds the best: from many
    starts, the least peak and the machine of today among them, SciPy's SLSQP goes down to a low
    place, and the best one is returned. Those two are always looked at, also where that takes
    longer than the `seconds`. No bound is known then; `tried` shows how far apart the low places
    are. A part without a load counts for nothing in it: its peak stays at most what it is today,
    or what `at_most` says.

    Otherwise no largest peak is less than that of the answer, as far as the solver
    HiGHS can be trusted: it searches the program through, to a ten-thousandth (where the `seconds`
    are enough; `bound` tells). Arcs that a rule keeps apart stay so by 4e-6 deg, for rounding, if
    they need not touch. Today's diagram is returned where it keeps all of this and nothing better
    is found. What is found is checked before it is returned by `find_violations` and by its curves;
    raises WrongAnswerError if that fails.
    Raises InputError for what is out of range, for a force or a torque without a Camshaft, for laws
    that do not rest at both ends or whose velocity jumps, for an arc over which a part does not
    stand, for a rule that says no position of a free part (of a distance, or of what moves or
    stands), where no starts and angles keep the rules, and where the time was too short to tell.

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
    >>> shaft = cm.Camshaft(
    ...     machine, {"mill": cm.FollowerLoad(mass_kg=40), "die": cm.FollowerLoad(mass_kg=12)})
    >>> both = {"mill": [(205, 305)], "die": [(205, 305)]}
    >>> least = optimise(shaft, rule, still=both, minimise="torque")
    >>> print(f"{abs(shaft.peak_torque().value):.2f} to {least.reached:.2f} N m")
    3.37 to 0.88 N m
    """
    what, limit = one_of("quantity to minimise", minimise, _UNITS), _SECONDS.number(seconds)
    shaft = None if what == "peak" else _shaft(diagram, what, weights)
    diagram = diagram.diagram if isinstance(diagram, Camshaft) else diagram
    if shaft and what == "force":
        loads = {name: one_of(LOADED, name, shaft.loads) for name in arcs_by_name(diagram, still)}
        weights = {name: shaft.loads[load].mass_kg for name, load in loads.items()}
    task = read_task(diagram, rules, still=still, weights=weights, at_most=at_most)
    named = unit or _UNITS[what]
    if shaft and what == "torque":
        task = task.no_harder(task.weights.keys() - shaft.loads.keys())
        found = least_torque(shaft, task, *read_moves(task, laws, (starts_deg, angles_deg)), limit)
        answer = found and Optimised(diagram, 0.0, found[0], task.weights, named, shaft, found[1])
    else:
        best = _best(task, laws, (starts_deg, angles_deg), limit)
        answer = best and Optimised(diagram, best[1], best[0], task.weights, named)
    if answer is None:
        raise InputError(
            "No starts and angles of these moves keep all of this: allow larger ranges or peaks, "
            "give shorter still arcs, or weaker rules."
        )
    _check(task, answer)
    return answer


def _shaft(given: TimingDiagram | Camshaft, what: str, weights: Any) -> Camshaft:
    """Return the shaft whose forces or torque are made small; raise InputError without one."""
    if not isinstance(given, Camshaft):
        raise InputError(
            f"A {what} needs to know what moves: give in place of the diagram a Camshaft with its "
            "loads, for example Camshaft(diagram, {'die': FollowerLoad(mass_kg=12)})."
        )
    if weights is not None:
        raise InputError(
            f"The weights are for peaks, and the {what} counts the masses of the loads: leave out "
            "the weights, or give minimise='peak'."
        )
    return given


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
    """Return the best diagram and its bound, which nothing has checked yet.

    It is the one of today if that is allowed and what is found is no better, in another order of
    the moves or in that of today. A bound that today's is below is none.
    """
    movers, apart = read_moves(task, laws, ranges)
    now = today(task, movers)
    try:
        found = place(movers, apart, seconds)
    except InputError:  # the time was too short to tell, but not for today's
        if now is None:
            raise
        found = Found(None, 0.0)
    design = built(task, found.moves) if found.moves else None
    if design and found.touching and [*faults_of(task, design)]:
        design = None
    bound = task.in_metres(found.bound)
    if now:
        least = weighted_peak(now, task.weights)
        bound = min(bound, least) if least >= bound * (1 - _SHARE) else 0.0
        if not (design and _is_better(task, design)):
            moves = place_as_today(task, movers, apart)
            design = built(task, moves) if moves else now
            design = design if _is_better(task, design) else now
    return (design, bound) if design else None


def _is_better(task: Task, design: TimingDiagram) -> bool:
    """Whether a design is better than today's: in its largest peak, or else the next, and so on.

    Where the peaks of all parts are alike, those of all moves are compared.
    """
    before, after = _peaks(task, task.diagram), _peaks(task, design)
    differ = (n for n, (old, new) in enumerate(zip(before, after, strict=True)) if _other(old, new))
    first = next(differ, None)
    return first is not None and after[first] < before[first]


def _peaks(task: Task, diagram: TimingDiagram) -> list[float]:
    """Return the weighted peaks in mm/deg2 of the parts, the largest first, then of all moves."""
    moves = [
        [part.weight * turn_peak(move) for move in diagram[part.motion.name].moves]
        for part in task.parts
        if part.weight
    ]
    parts = sorted((max(part, default=0.0) for part in moves), reverse=True)
    return [*parts, *sorted((one for part in moves for one in part), reverse=True)]


def _other(old: float, new: float) -> bool:
    return abs(new - old) > _SHARE * old


def turn_peak(move: Segment) -> float:
    """Return the peak of a move in mm/deg²; infinite where its velocity jumps."""
    return as_law(move.law).Ca * abs(move.change_mm) / move.angle_deg**2


def _check(task: Task, answer: Optimised) -> None:
    """Raise WrongAnswerError unless the design keeps what it has to and has the peak promised."""
    faults = [*faults_of(task, answer.design)]
    if answer.reached < answer.bound * (1 - _SHARE):
        faults.append(f"it reaches {answer.reached:g}, less than the bound {answer.bound:g}")
    if faults:
        raise WrongAnswerError("optimise", "; ".join(faults))
