"""The compiled SCCA family against the laws it stands for."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from machines import examples

import cammotion as cm
from cammotion.laws.scca_family import NAMED_PARTS, SccaCurves, acceleration_factor

THIRDS = (1 / 3, 1 / 3, 1 / 3)
EDGES = [(1, 0, 0), (0.4, 0.6, 0), (0, 0.3, 0.7), (0.7, 0, 0.3), (0.01, 0.98, 0.01), THIRDS]


def check(parts: tuple[float, float, float]) -> None:
    """Compare every curve in every zone, and every factor, with those of the law."""
    law, curves = cm.scca(*parts), SccaCurves(*parts)
    zones = curves.sample(9)
    assert len(zones) == 2 * sum(part > 0 for part in curves.parts)
    assert np.all(zones[1:, 0, 0] == pytest.approx(zones[:-1, 0, -1]))
    assert (zones[0, 0, 0], zones[-1, 0, -1]) == (0, 1)
    for x, *values in zones[:, :, 1:-1]:
        for order, heights in enumerate(values):
            exact = law(x, order)
            assert heights == pytest.approx(exact, rel=1e-9, abs=1e-9 * max(1, *abs(exact)))
    for factor in ("Cv", "Ca", "Cj", "Cj_inside", "Cq"):
        assert getattr(curves, factor) == pytest.approx(getattr(law, factor), rel=1e-10), factor
    jumps = {place for place, _ in law.jerk_impulses}
    assert (jumps >= {0, 1}, 0.5 in jumps) == (curves.jumps_at_ends, curves.jumps_in_middle)
    assert acceleration_factor(parts[0], parts[2]) == pytest.approx(law.Ca, rel=1e-12)


@pytest.mark.parametrize("parts", [*NAMED_PARTS.values(), *EDGES])
def test_the_compiled_family_on_the_edges_and_at_the_named_laws(
    parts: tuple[float, float, float],
) -> None:
    check(parts)


@examples(15)
@given(st.integers(0, 1000), st.integers(0, 1000))
def test_the_compiled_family_anywhere(one: int, other: int) -> None:
    low, high = sorted([one, other])
    check((low / 1000, (high - low) / 1000, (1000 - high) / 1000))


def test_the_named_parts_are_those_of_the_catalogue() -> None:
    places = np.linspace(0, 1, 201)
    for name, parts in NAMED_PARTS.items():
        assert cm.scca(*parts)(places) == pytest.approx(cm.LAWS[name](places), abs=1e-13)


def test_no_law_accelerates_less_than_the_constant_one() -> None:
    b, of_rest = np.meshgrid(np.linspace(0, 1, 101), np.linspace(0, 1, 101))
    factors = acceleration_factor(b, (1 - b) * of_rest)
    assert factors.min() == factors[0, 0] == pytest.approx(4)
    assert factors.max() == pytest.approx(np.pi**2 / (np.pi - 2))


@pytest.mark.parametrize("parts", [(0.7, 0.3 + 3e-10, 0), (0.7, 0.3 - 3e-10, 0), (0.5, 0.5, 1e-20)])
def test_rounding_does_not_become_a_zone(parts: tuple[float, float, float]) -> None:
    assert SccaCurves(*parts).parts[2] == 0
    law = cm.scca(*parts)
    assert (law(0.0), law(0.5), law(1.0)) == pytest.approx((0, 0.5, 1), abs=1e-15)
    assert [place for place, _ in law.jerk_impulses] == [0.5]


def test_parts_that_are_no_law_are_refused() -> None:
    with pytest.raises(cm.InputError, match=r"add up to 0\.9: let b, c and d add up to 1"):
        SccaCurves(0.3, 0.3, 0.3)
    with pytest.raises(cm.InputError, match=r"b \+ d of the SCCA law is 1\.2: let b and d add"):
        acceleration_factor([0.5, 0.6], [0.5, 0.6])
    with pytest.raises(cm.InputError, match=r"zone of the SCCA law is -0\.1"):
        acceleration_factor(-0.1, 0)
