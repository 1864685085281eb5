"""A bound from below does not rest on what the solver says of itself."""

import math
from itertools import product
from typing import Any

import numpy as np
import pytest
from scipy import optimize, sparse

import cammotion as cm
from cammotion.limits import programs
from cammotion.limits.linear import Program, proved_bound, search, solve

ROW = sparse.csr_matrix(np.array([[-1.0, -2.0]]))
NONE = [sparse.csr_matrix((1, 2))], [np.zeros(1)]
# the least of x + y with x + 2y at least 4, x and y from 0 on: 2, at y = 2
SMALL = Program(
    np.ones(2),
    ([ROW], [np.array([-4.0])]),
    NONE,
    np.array([[0.0, math.inf]] * 2),
    "Nothing.",
    sizes=(np.zeros(2), np.ones(2)),
)


def die_program(monkeypatch: pytest.MonkeyPatch, **more: Any) -> Program:
    """Return the program from below of the example's die."""
    seen: list[Program] = []

    def keep(program: Program) -> Any:
        seen.append(program)
        return solve(program)

    monkeypatch.setattr(programs, "solve", keep)
    diagram, rule = cm.EXAMPLE.diagram, cm.EXAMPLE.rule
    cm.least_acceleration(diagram, "die", rule, still=[(205, 305)], cells=90, **more)
    return seen[0]


def test_the_bound_of_a_small_program_can_be_followed_by_hand() -> None:
    # half of the row: x/2 + y is at least 2, and what is left, x/2, is at least 0
    assert proved_bound(SMALL, SMALL.bounds, np.array([-0.5]), np.zeros(1)) == 2
    # a little too much: -0.02 y is left, and y is at most the objective itself
    found = proved_bound(SMALL, SMALL.bounds, np.array([-0.51]), np.zeros(1))
    assert found == pytest.approx(4 * 0.51 / 1.02)
    # and if all that is known of y is that it is at most 150, 0.02 of that may be lost
    loose = SMALL._replace(sizes=(np.array([0.0, 150.0]), np.zeros(2)))
    found = proved_bound(loose, SMALL.bounds, np.array([-0.51]), np.zeros(1))
    assert found == pytest.approx(4 * 0.51 - 0.02 * 150)
    assert solve(SMALL).bound == 2


@pytest.mark.parametrize("more", [{}, {"travel_mm": (0, 50)}, {"jerk_m_per_s3": 12.0}])
def test_it_is_as_good_as_what_the_solver_says(
    monkeypatch: pytest.MonkeyPatch, more: dict[str, Any]
) -> None:
    program = die_program(monkeypatch, **more)
    assert solve(program).bound == pytest.approx(solve(program._replace(sizes=None)).bound)
    assert solve(program).bound <= solve(program._replace(sizes=None)).bound


@pytest.mark.parametrize("seed", range(5))
def test_wrong_multipliers_give_a_poor_bound_and_never_a_wrong_one(
    monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    program = die_program(monkeypatch, travel_mm=(0, 50))
    least = solve(program).bound
    rng = np.random.default_rng(seed)
    counts = [sum(len(part) for part in side[1]) for side in (program.at_most, program.equal)]
    at_most, equal = (rng.normal(size=count) for count in counts)
    assert proved_bound(program, program.bounds, -np.abs(at_most), equal) < least


def test_a_solver_that_claims_too_much_is_not_believed(monkeypatch: pytest.MonkeyPatch) -> None:
    program, honest = die_program(monkeypatch), optimize.linprog

    def boasting(*given: Any, **more: Any) -> Any:
        result = honest(*given, **more)
        result.fun *= 1.01
        return result

    least = solve(program).bound
    monkeypatch.setattr(optimize, "linprog", boasting)
    assert solve(program).bound == pytest.approx(least)


def test_without_sizes_nothing_is_proved() -> None:
    with pytest.raises(cm.InputError, match="how large its unknowns can be"):
        proved_bound(SMALL._replace(sizes=None), SMALL.bounds, np.array([-0.51]), np.zeros(1))


# Choices, and programs without a solution


def choosing(rng: np.random.Generator, groups: int = 4, size: int = 3) -> Program:
    """Return a program in which numbers from 0 to 1 lie above what is chosen, and cost as much."""
    cost = rng.uniform(0, 1, (groups, size))
    count = groups * (size + 1)
    rows, limits = [], []
    for group, of_group in enumerate(cost):
        number, picks = group, groups + group * size + np.arange(size)
        row = np.zeros((3, count))
        row[0, number], row[0, picks] = -1.0, of_group
        row[1, picks], row[2, picks] = 1.0, -1.0
        rows.append(sparse.csr_matrix(row))
        limits.append(np.array([0.0, 1.0, -1.0]))
    for _ in range(3):  # what may not be chosen together
        row = np.zeros((1, count))
        row[0, groups + rng.choice(groups * size, 5, replace=False)] = 1.0
        rows.append(sparse.csr_matrix(row))
        limits.append(np.array([1.0]))
    return Program(
        np.where(np.arange(count) < groups, 1.0, 0.0),
        (rows, limits),
        ([sparse.csr_matrix((0, count))], [np.zeros(0)]),
        np.tile([0.0, 1.0], (count, 1)),
        "Nothing.",
        choices=[[groups + group * size + n for n in range(size)] for group in range(groups)],
    )


def best_by_trying(program: Program) -> float:
    """Return the least cost of all choices; infinite if none keep the rows."""
    rows, limits = sparse.vstack(program.at_most[0]).toarray(), np.concatenate(program.at_most[1])
    costs = []
    for taken in product(*program.choices):
        x = np.zeros(len(program.objective))
        x[list(taken)] = 1.0
        for number in range(len(program.choices)):
            own = rows[:, number] < 0
            x[number] = max((rows[own] @ x - limits[own]).max(), 0.0)
        if np.all(rows @ x <= limits + 1e-9):
            costs.append(float(program.objective @ x))
    return min(costs, default=math.inf)


@pytest.mark.parametrize("seed", range(12))
def test_of_choices_the_best_is_found(seed: int) -> None:
    program = choosing(np.random.default_rng(seed))
    unknowns, bound = search(program)
    assert bound == pytest.approx(best_by_trying(program))
    assert (unknowns is None) == math.isinf(bound)


@pytest.mark.parametrize("seed", range(12))
def test_stopped_early_its_bound_is_still_true(seed: int) -> None:
    program = choosing(np.random.default_rng(seed), groups=6)
    for most in (1, 2, 4, 8):
        assert search(program, most=most)[1] <= search(program)[1] + 1e-9


@pytest.mark.parametrize("seed", range(6))
def test_a_solver_that_sees_no_solution_is_not_believed(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As HiGHS has been seen to do: it calls a program infeasible that is not."""
    program, honest = choosing(np.random.default_rng(seed)), optimize.linprog
    least = best_by_trying(program)

    def blind(objective: Any, **more: Any) -> Any:
        result = honest(objective, **more)
        if len(objective) == len(program.objective):
            result.status = 2
        return result

    monkeypatch.setattr(optimize, "linprog", blind)
    if np.isfinite(least):
        assert search(program)[1] <= least
    else:
        assert search(program) == (None, math.inf)


def test_without_a_solution_the_proof_is_another_program() -> None:
    row = sparse.csr_matrix(np.array([[1.0, 1.0], [-1.0, -1.0]]))
    program = SMALL._replace(
        at_most=([row], [np.array([1.0, -1.001])]), bounds=np.array([[0.0, 5.0]] * 2), sizes=None
    )
    assert search(program) == (None, math.inf)
    with pytest.raises(cm.InputError, match="Nothing"):
        solve(program)
