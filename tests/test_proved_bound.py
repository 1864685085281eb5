"""A bound from below does not rest on what the solver says of itself."""

import math
from typing import Any

import numpy as np
import pytest
from scipy import optimize, sparse

import cammotion as cm
from cammotion.limits import programs
from cammotion.limits.linear import Program, proved_bound, solve

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
    assert solve(SMALL).bound == 2


@pytest.mark.parametrize("more", [{}, {"travel_mm": (0, 50)}, {"jerk_limit": 12.0}])
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
        proved_bound(SMALL._replace(sizes=None), SMALL.bounds, np.zeros(1), np.zeros(1))
