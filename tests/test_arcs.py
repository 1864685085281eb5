"""Sets of cam angles against a mask of the turn, angle by angle."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from machines import examples
from numpy.typing import NDArray

from cammotion.machine.arcs import ROUNDING_DEG, Arc, arcs, complement, intersect, unwrap

PLACES = np.arange(0, 360, 0.5) + 0.25
"""Angles half-way between the whole and half ones at which the arcs below begin and end."""

half_degrees = st.integers(-1500, 1500).map(lambda n: n / 2)
lengths = st.integers(0, 720).map(lambda n: n / 2)
pieces = st.lists(st.builds(lambda start, way: (start, start + way), half_degrees, lengths))


def mask(these: list[Arc]) -> NDArray[np.bool_]:
    """Return which of the places the arcs cover, at whatever angles they are given."""
    covered = np.zeros(PLACES.shape, bool)
    for start, end in these:
        for turn in range(-4, 5):
            covered |= (start < PLACES + 360 * turn) & (PLACES + 360 * turn < end)
    return covered


def is_a_set(these: list[Arc]) -> bool:
    """Return whether the arcs lie in the turn, in order, and do not touch."""
    ends = [angle for arc in these for angle in arc]
    return all(a < b for a, b in zip([-1, *ends], [*ends, 361], strict=True)) and (
        not ends or (ends[0] >= 0 and ends[-1] <= 360)
    )


@examples(100)
@given(pieces)
def test_a_set_covers_its_pieces_and_no_more(given_pieces: list[Arc]) -> None:
    assert is_a_set(arcs(given_pieces))
    assert (mask(arcs(given_pieces)) == mask(given_pieces)).all()


@examples(100)
@given(pieces)
def test_the_complement_is_the_rest(given_pieces: list[Arc]) -> None:
    these = arcs(given_pieces)
    assert is_a_set(complement(these))
    assert (mask(complement(these)) == ~mask(these)).all()
    assert complement(complement(these)) == these


@examples(100)
@given(pieces, pieces)
def test_the_intersection_is_in_both(ones: list[Arc], others: list[Arc]) -> None:
    both = intersect(arcs(ones), arcs(others))
    assert is_a_set(both)
    assert (mask(both) == mask(ones) & mask(others)).all()
    assert both == intersect(arcs(others), arcs(ones))


@examples(100)
@given(pieces)
def test_joining_covers_the_same_with_no_seam_at_360(given_pieces: list[Arc]) -> None:
    these = arcs(given_pieces)
    joined = unwrap(these)
    assert (mask(joined) == mask(these)).all()
    assert arcs(joined) == these
    starts_and_ends = {angle % 360 for arc in joined for angle in arc}
    assert 0 not in starts_and_ends or len(joined) == 1 or mask(joined)[0] != mask(joined)[-1]


@examples(100)
@given(pieces, st.integers(-5, 5))
def test_a_turn_further_is_the_same(given_pieces: list[Arc], turns: int) -> None:
    shifted = [(start + 360 * turns, end + 360 * turns) for start, end in given_pieces]
    assert arcs(shifted) == arcs(given_pieces)


@examples(100)
@given(st.floats(-2000, 2000), st.floats(1e-3, 359), st.floats(0, 1))
def test_neighbours_make_one_arc_wherever_they_meet(start: float, way: float, cut: float) -> None:
    """Also where their common end misses 360 deg by its rounding."""
    end = start + way
    parts = [(start, start + cut * way), (start + cut * way, end)]
    assert len(unwrap(arcs(parts))) == 1
    assert len(unwrap(complement(arcs(parts)))) == 1


def test_the_turn_in_one_arc() -> None:
    assert arcs([(0, 360)]) == arcs([(-80, 280)]) == arcs([(10, 200), (150, 370)]) == [(0, 360)]
    assert complement([(0, 360)]) == []
    assert complement([]) == [(0, 360)]
    assert unwrap([(0, 360)]) == [(0, 360)]
    assert unwrap([]) == arcs([]) == []


def test_the_ends_of_a_turn_are_exact() -> None:
    assert arcs([(300, 360 - 1e-13)]) == [(300, 360)]
    assert arcs([(360 + 1e-13, 400)]) == arcs([(-1e-13, 40)]) == [(0, 40)]
    assert unwrap(arcs([(300, 360 - 1e-13), (1e-13, 40)])) == [(300, 400)]


def test_rounding_is_dropped_and_nothing_longer() -> None:
    short, long = ROUNDING_DEG / 2, ROUNDING_DEG * 2
    assert arcs([(10, 10 + short)]) == []
    assert len(arcs([(10, 10 + long)])) == 1
    assert arcs([(10, 20), (20 + short, 30)]) == [(10, 30)]
    assert len(arcs([(10, 20), (20 + long, 30)])) == 2
    assert intersect([(10, 20)], [(20 - short, 30)]) == []
    assert len(intersect([(10, 20)], [(20 - long, 30)])) == 1
