"""The SCCA family against its closed forms, and against sampling."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from long_arrays import assert_near
from machines import examples

import cammotion as cm
from cammotion.laws.scca_family import NAMED_PARTS, scca_factor

THIRDS = (1 / 3, 1 / 3, 1 / 3)
EDGES = [(1, 0, 0), (0.4, 0.6, 0), (0, 0.3, 0.7), (0.7, 0, 0.3), (0.01, 0.98, 0.01), THIRDS]


def check(parts: tuple[float, float, float]) -> None:
    """Compare a law with the formulas of the family, which are written here once more."""
    law, (b, c, d) = cm.scca(*parts), parts
    peak = (
        4 * np.pi**2 / ((np.pi**2 - 8) * (b * b - d * d) - 2 * np.pi * (np.pi - 2) * b + np.pi**2)
    )
    assert law.Ca == pytest.approx(peak, rel=1e-12)
    assert law.Cv == pytest.approx(peak * ((b + d) / np.pi + c / 2), rel=1e-12)
    steepest = [np.pi * peak / part for part in (b, d) if part]
    assert law.Cj_inside == pytest.approx(max(steepest, default=0.0), rel=1e-12)
    assert np.isinf(law.Cj) == (b == 0 or d == 0)
    assert [place for place, _ in law.jerk_impulses] == [0] * (not b) + [0.5] * (not d) + [1] * (
        not b
    )
    x = np.linspace(0, 0.5, 20_001)
    ends = np.array([b / 2, (b + c) / 2])
    rising = np.sin(np.pi * x / b) if b else np.ones_like(x)
    falling = np.cos(np.pi * (x - ends[1]) / d) if d else np.ones_like(x)
    wanted = peak * np.select([x < ends[0], x <= ends[1]], [rising, 1.0], falling)
    away = np.all(np.abs(x[:, None] - ends) > 1e-9, axis=1)
    assert_near(law(x, 2)[away], wanted[away], abs=1e-9 * peak)
    assert_near(law(1 - x, 2)[away], -wanted[away], abs=1e-9 * peak)
    velocity = np.concatenate([[0.0], np.cumsum((wanted[1:] + wanted[:-1]) / 2) * (x[1] - x[0])])
    assert_near(law(x, 1), velocity, abs=2e-4 * peak)
    assert law.Cq == pytest.approx(np.max(law(x, 1) * np.abs(law(x, 2))), rel=1e-6)
    assert scca_factor(b, d, np.pi) == pytest.approx(peak, rel=1e-12)


@pytest.mark.parametrize("parts", [*NAMED_PARTS.values(), *EDGES])
def test_the_family_on_the_edges_and_at_the_named_laws(
    parts: tuple[float, float, float],
) -> None:
    check(parts)


@examples(6)
@given(st.integers(0, 1000), st.integers(0, 1000))
def test_the_family_anywhere(one: int, other: int) -> None:
    low, high = sorted([one, other])
    check((low / 1000, (high - low) / 1000, (1000 - high) / 1000))


def test_the_named_parts_are_those_of_the_catalogue() -> None:
    places = np.linspace(0, 1, 201)
    for name, parts in NAMED_PARTS.items():
        assert cm.scca(*parts)(places) == pytest.approx(cm.LAWS[name](places), abs=1e-13)


def test_no_law_accelerates_less_than_the_constant_one() -> None:
    b, of_rest = np.meshgrid(np.linspace(0, 1, 101), np.linspace(0, 1, 101))
    factors = scca_factor(b, (1 - b) * of_rest, np.pi)
    assert factors.min() == factors[0, 0] == pytest.approx(4)
    assert factors.max() == pytest.approx(np.pi**2 / (np.pi - 2))


@pytest.mark.parametrize("parts", [(0.7, 0.3 + 3e-10, 0), (0.7, 0.3 - 3e-10, 0), (0.5, 0.5, 1e-20)])
def test_rounding_does_not_become_a_zone(parts: tuple[float, float, float]) -> None:
    law = cm.scca(*parts)
    assert (law(0.0), law(0.5), law(1.0)) == pytest.approx((0, 0.5, 1), abs=1e-15)
    assert [place for place, _ in law.jerk_impulses] == [0.5]


def test_parts_that_are_no_law_are_refused() -> None:
    with pytest.raises(cm.InputError, match=r"add up to 0\.9: let b, c and d add up to 1"):
        cm.scca(0.3, 0.3, 0.3)
    with pytest.raises(cm.InputError, match=r"zone of the SCCA law is -0\.1"):
        cm.scca(-0.1, 1, 0.1)
