"""Linear programs, solved by HiGHS; some of their unknowns may have to be whole numbers."""

import heapq
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from cammotion.quantities import Floats, InputError

Matrix = Any  # SciPy's sparse matrices come without types
System = tuple[Sequence[Matrix], Sequence[Floats]]
"""Rows of a program, and what they may be at most or have to be."""

_SOLVED, _INFEASIBLE = 0, 2
_WHOLE = 1e-6  # so near to a whole number is one
_MOST_PROGRAMS = 400


class Program(NamedTuple):
    """The least of `objective @ x` with rows that bound x or fix it, and with its bounds.

    `bounds` has a row for each unknown, its least and its largest value; the last `whole` unknowns
    have to be whole numbers. `refusal` says what is wrong if there is no solution. With `sizes`,
    (fixed, per), no unknown is farther from 0 than fixed + per times the objective in any solution
    that matters: by this the bound is proved, whatever the solver has rounded.
    """

    objective: Floats
    at_most: System
    equal: System
    bounds: Floats
    refusal: str
    whole: int = 0
    sizes: tuple[Floats, Floats] | None = None


class Solution(NamedTuple):
    """The unknowns of a program, and the number that its objective is not below.

    If the program gives the sizes of its unknowns, the bound is not the solver's word: it is
    computed anew from the solver's multipliers (the dual), by `proved_bound`.
    """

    unknowns: Floats
    bound: float


def solve(program: Program) -> Solution:
    """Return the solution of a program; raises InputError with its refusal if it has none.

    Whole numbers are found by halving: where an unknown lies between two of them, it is at most
    the one or at least the other. Of all halves the one with the least objective is looked at
    next. None of the others can come below it, and so it is the best as soon as it is whole.
    """
    found = _solve_one(program, program.bounds)
    halves = [] if found is None else [(*_order(found.bound, 0), 0, found, program.bounds)]
    solved = 1
    while halves:
        _, depth, _, found, bounds = heapq.heappop(halves)
        number = _not_whole(program, found.unknowns)
        if number is None:
            least = min([found.bound, *(half[3].bound for half in halves)])
            return Solution(found.unknowns, least)
        if solved > _MOST_PROGRAMS:
            raise InputError(
                f"At which stops it is best was not found with {solved} linear programs: give "
                "fewer rules, or take fewer cells."
            )
        value = found.unknowns[number]
        for column, end in ((1, np.floor(value)), (0, np.ceil(value))):
            half = bounds.copy()
            half[number, column] = end
            solved += 1
            better = _solve_one(program, half)
            if better is not None:
                heapq.heappush(halves, (*_order(better.bound, depth - 1), solved, better, half))
    raise InputError(program.refusal)


def _order(bound: float, depth: int) -> tuple[float, int]:
    """Return what decides which half is next: of those that differ by rounding, the deepest."""
    return float(f"{bound:.6g}"), depth


def _not_whole(program: Program, unknowns: Floats) -> int | None:
    """Return the unknown that has to be whole and is farthest from it; None if all are whole."""
    first = len(unknowns) - program.whole
    away = np.abs(unknowns[first:] - np.round(unknowns[first:]))
    return first + int(np.argmax(away)) if np.any(away > _WHOLE) else None


def _solve_one(program: Program, bounds: Floats) -> Solution | None:
    """Solve with any numbers for the whole ones; None if there is no solution."""
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
        if result.status in (_SOLVED, _INFEASIBLE):
            break
    if result.status == _INFEASIBLE:
        return None
    if result.status != _SOLVED:
        raise InputError(f"The linear program was not solved ({result.message}): change the grid.")
    bound = float(result.fun)
    if program.sizes is not None:
        at_most, equal = result.ineqlin.marginals, result.eqlin.marginals
        proved = proved_bound(program, bounds, np.minimum(at_most, 0.0), np.asarray(equal))
        bound = min(bound, proved)
    return Solution(np.asarray(result.x), bound)


def proved_bound(program: Program, bounds: Floats, at_most: Floats, equal: Floats) -> float:
    """Return a number that the objective of a program with `sizes` is not below.

    `at_most` (none above 0) and `equal` are multipliers of the rows, any that one likes: the rows
    times them are at least their limits times them, for every solution. What then is left of the
    objective is `rest @ unknowns`, and each unknown is at its better end. Good multipliers, those
    of the dual, give a good bound; bad ones give a poor one, but never a wrong one.
    """
    if program.sizes is None:
        raise InputError("The program does not say how large its unknowns can be: give `sizes`.")
    (rows, limits), (fixed, values) = map(_stacked, (program.at_most, program.equal))
    rest = program.objective - rows.T @ at_most - fixed.T @ equal
    end = np.where(rest > 0, bounds[:, 0], bounds[:, 1])
    has_end = np.isfinite(end)
    known = limits @ at_most + values @ equal + rest[has_end] @ end[has_end]
    size, per = (np.abs(rest[~has_end]) @ part[~has_end] for part in program.sizes)
    return float((known - size) / (1 + per)) if known > size else float(known - size)


def _stacked(system: System) -> tuple[Matrix, Floats]:
    from scipy import sparse

    return sparse.vstack(system[0]).tocsr(), np.concatenate(system[1])
