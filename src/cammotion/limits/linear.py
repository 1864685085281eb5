"""Linear programs, solved by HiGHS; some of their unknowns may have to be whole numbers."""

import heapq
from collections.abc import Sequence
from time import monotonic
from typing import Any, NamedTuple

import numpy as np

from cammotion.quantities import Floats, InputError

Matrix = Any  # SciPy's sparse matrices come without types
System = tuple[Sequence[Matrix], Sequence[Floats]]
"""Rows of a program, and what they may be at most or have to be."""

_SOLVED, INFEASIBLE = 0, 2  # the status of what SciPy has solved
_WHOLE = 1e-6  # so near to a whole number is one
_MISSED = 1e-9  # so far rows are missed by rounding alone
_MOST_PROGRAMS = 400


class Program(NamedTuple):
    """The least of `objective @ x` with rows that bound x or fix it, and with its bounds.

    `bounds` has a row for each unknown, its least and its largest value; the unknowns numbered in
    `whole` have to be whole numbers. `refusal` says what is wrong if there is no solution. With
    `sizes`, (fixed, per), no unknown is farther from 0 than fixed + per times the objective in any
    solution that matters. By this, or where all bounds are finite, what comes out is proved,
    whatever the solver has rounded.
    """

    objective: Floats
    at_most: System
    equal: System
    bounds: Floats
    refusal: str
    whole: Sequence[int] = ()
    choices: Sequence[Sequence[int]] = ()
    sizes: tuple[Floats, Floats] | None = None

    @property
    def is_bounded(self) -> bool:
        """Whether every unknown has a least and a largest value."""
        return bool(np.isfinite(self.bounds).all())


class Solution(NamedTuple):
    """The unknowns of a program, and the number that its objective is not below.

    If the program knows how large its unknowns can be, the bound is not the solver's word: it is
    computed anew from the solver's multipliers (the dual), by `proved_bound`.
    """

    unknowns: Floats
    bound: float


def solve(program: Program) -> Solution:
    """Return the solution of a program; raises InputError with its refusal if it has none."""
    unknowns, bound = search(program, most=_MOST_PROGRAMS)
    if unknowns is not None:
        return Solution(unknowns, bound)
    if np.isinf(bound):
        raise InputError(program.refusal)
    raise InputError(
        f"At which stops it is best was not found with {_MOST_PROGRAMS} linear programs: give "
        "fewer rules, or take fewer cells."
    )


def search(
    program: Program, *, seconds: float = np.inf, most: float = np.inf
) -> tuple[Floats | None, float]:
    """Return the unknowns with the least objective, and the number that it is not below.

    Whole numbers are found by halving: where an unknown lies between two of them, it is at most
    the one or at least the other; of a choice it is one of the first or one of the last. Of all
    halves the one with the least objective is looked at next. None of the others can come below
    it, and so it is the best as soon as it is whole.

    After so many `seconds`, or with `most` linear programs solved, the search ends with the bound
    that is known by then, and with the best whole unknowns of the halves, None if there are none.
    Without any solution the bound is infinite. In a program whose unknowns are all bounded that is
    not the solver's word either: for each half without a solution it is proved.
    """
    program = program._replace(at_most=_joined(program.at_most), equal=_joined(program.equal))
    end, solved = monotonic() + seconds, 1
    found = _relaxed(program, program.bounds, -np.inf)
    halves = [] if found is None else [(*_order(found.bound, 0), 0, found, program.bounds)]
    while halves:
        _, depth, _, found, bounds = heapq.heappop(halves)
        parts = _halved(program, found.unknowns, bounds)
        least = min([found.bound, *(half[3].bound for half in halves)])
        if not parts:
            return found.unknowns, least
        if solved >= most or monotonic() > end:
            return _best_of(program, halves), least
        for part in parts:
            solved += 1
            better = _relaxed(program, part, found.bound)
            if better is not None:
                heapq.heappush(halves, (*_order(better.bound, depth - 1), solved, better, part))
    return None, np.inf


def _order(bound: float, depth: int) -> tuple[float, int]:
    """Return what decides which half is next: of those that differ by rounding, the deepest."""
    return float(f"{bound:.6g}"), depth


def _best_of(program: Program, halves: Sequence[tuple[Any, ...]]) -> Floats | None:
    """Return the best unknowns of halves that need not be halved any more; None if all need."""
    whole = [found for *_, found, bounds in halves if not _halved(program, found.unknowns, bounds)]
    return min(whole, key=lambda found: found.bound).unknowns if whole else None


def _halved(program: Program, unknowns: Floats, bounds: Floats) -> list[Floats]:
    """Return the two halves of what is farthest from whole, by their bounds; none if all is."""
    first, second = bounds.copy(), bounds.copy()
    numbers = unknowns[np.array(program.whole, dtype=int)]
    away = np.abs(numbers - np.round(numbers))
    undecided = [1 - unknowns[choice].max() for choice in program.choices]
    if away.max(initial=0.0) > _WHOLE:
        number = program.whole[int(np.argmax(away))]
        first[number, 1], second[number, 0] = np.floor(unknowns[number]), np.ceil(unknowns[number])
    elif max(undecided, default=0.0) > _WHOLE:
        choice = program.choices[int(np.argmax(undecided))]
        taken = np.cumsum(unknowns[choice])
        last = 1 + int(np.clip(np.searchsorted(taken, taken[-1] / 2), 0, len(choice) - 2))
        first[choice[last:], 1], second[choice[:last], 1] = 0.0, 0.0
    else:
        return []
    return [first, second]


def _relaxed(program: Program, bounds: Floats, above: float) -> Solution | None:
    """Solve with any numbers for the whole ones; None if there is no solution.

    The objective is known not to be below `above`.
    """
    found = _solve_one(program, bounds)
    if found is None and program.is_bounded:
        found = _nearest(program, bounds)
    return found and found._replace(bound=max(found.bound, above))


def _solve_one(program: Program, bounds: Floats) -> Solution | None:
    """Solve without regard to whole numbers; None if the solver says that there is no solution."""
    from scipy.optimize import linprog

    (rows, limits), (fixed, values) = map(_stacked, (program.at_most, program.equal))
    for method in ("highs", "highs-ipm"):  # the second where the first cannot tell
        result = linprog(
            program.objective,
            A_ub=rows,
            b_ub=limits,
            A_eq=fixed,
            b_eq=values,
            bounds=bounds,
            method=method,
        )
        if result.status in (_SOLVED, INFEASIBLE):
            break
    if result.status == INFEASIBLE:
        return None
    if result.status != _SOLVED:
        raise InputError(
            f"The linear program was not solved ({result.message}): take another grid, or ask for "
            "less."
        )
    bound = float(result.fun)
    if program.is_bounded or program.sizes is not None:
        at_most, equal = result.ineqlin.marginals, result.eqlin.marginals
        proved = proved_bound(program, bounds, np.minimum(at_most, 0.0), np.asarray(equal))
        bound = min(bound, proved)
    return Solution(np.asarray(result.x), bound)


def _nearest(program: Program, bounds: Floats) -> Solution | None:
    """Return what misses the rows of a bounded program by the least; None if that is proved.

    How far the farthest row is missed is the objective of another program. If that is above 0 by
    its own proof, there is no solution.
    """
    from scipy import sparse

    (rows, limits), (fixed, values) = map(_stacked, (program.at_most, program.equal))
    every, ends = sparse.vstack([rows, fixed, -fixed]), np.concatenate([limits, values, -values])
    farthest = float(np.max(abs(every) @ np.abs(bounds).max(axis=1) + np.abs(ends), initial=0.0))
    missing = sparse.hstack([every, -np.ones((every.shape[0], 1))]).tocsr()
    none = sparse.csr_matrix((0, missing.shape[1]))
    least = Program(
        np.eye(1, missing.shape[1], missing.shape[1] - 1)[0],
        ([missing], [ends]),
        ([none], [np.zeros(0)]),
        np.vstack([bounds, [0.0, farthest]]),
        program.refusal,
    )
    found = _solve_one(least, least.bounds)
    if found is None or found.bound > _MISSED:
        return None
    return Solution(found.unknowns[:-1], -np.inf)


def proved_bound(program: Program, bounds: Floats, at_most: Floats, equal: Floats) -> float:
    """Return a number that the objective of a program is not below.

    `at_most` (none above 0) and `equal` are multipliers of the rows, any that one likes: the rows
    times them are at least their limits times them, for every solution. What then is left of the
    objective is `rest @ unknowns`, and each unknown is at its better end, or no farther than the
    program's `sizes` say. Good multipliers, those of the dual, give a good bound; bad ones give a
    poor one, but never a wrong one.
    """
    (rows, limits), (fixed, values) = map(_stacked, (program.at_most, program.equal))
    rest = program.objective - rows.T @ at_most - fixed.T @ equal
    end = np.where(rest > 0, bounds[:, 0], bounds[:, 1])
    has_end = np.isfinite(end)
    known = limits @ at_most + values @ equal + rest[has_end] @ end[has_end]
    if has_end.all():
        return float(known)
    if program.sizes is None:
        raise InputError("The program does not say how large its unknowns can be: give `sizes`.")
    size, per = (np.abs(rest[~has_end]) @ part[~has_end] for part in program.sizes)
    return float((known - size) / (1 + per)) if known > size else float(known - size)


def _joined(system: System) -> System:
    rows, limits = _stacked(system)
    return [rows], [limits]


def _stacked(system: System) -> tuple[Matrix, Floats]:
    from scipy import sparse

    rows, limits = system
    return (rows[0] if len(rows) == 1 else sparse.vstack(rows).tocsr()), np.concatenate(limits)
