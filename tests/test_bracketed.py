"""What is searched for between samples: the largest of peaks, and arcs narrower than a step."""

import numpy as np
import pytest
from machines import Array

from cammotion.bracketed import largest, samples, where_positive
from cammotion.laws.piece import Piece
from cammotion.teaching.example import EXAMPLE

PIECES = EXAMPLE.die.curve.pieces
BETWEEN = 180.125  # half-way between two samples of the way down


def peak(at: Array, place: float, height: float, sharpness: float) -> Array:
    return height - sharpness * (at - place) ** 2


def two_peaks(_: Piece, at: Array) -> Array:
    """One of height 10 on a sample, and a higher, narrower one, whose samples are lower."""
    low, high = peak(at, 160, 10, 1), peak(at, BETWEEN, 10.1, 20)
    return np.maximum(np.maximum(low, high), 0)


def test_a_peak_between_samples_is_found_though_its_samples_are_lower() -> None:
    (way_down, *_) = PIECES
    near = samples(way_down)[np.abs(samples(way_down) - BETWEEN) < 0.2]
    assert two_peaks(way_down, near).max() < 10
    found = largest(two_peaks, PIECES)
    assert found.value == pytest.approx(10.1)
    assert found.at_deg == pytest.approx(BETWEEN, abs=1e-6)


def test_an_arc_between_samples_is_found_with_its_ends() -> None:
    """Above 0 for a tenth of a degree, between two samples that are below."""

    def hidden(_: Piece, at: Array) -> Array:
        return np.maximum(peak(at, BETWEEN, 0.05, 20), -10)

    assert np.all(hidden(PIECES[0], samples(PIECES[0])) < 0)
    half = (0.05 / 20) ** 0.5
    ((start, end),) = where_positive(hidden, PIECES)
    assert (start, end) == pytest.approx((BETWEEN - half, BETWEEN + half), abs=1e-9)


def test_what_is_above_zero_all_round_is_one_arc() -> None:
    assert where_positive(lambda _, at: np.ones_like(at), PIECES) == [(0, 360)]
    assert where_positive(lambda _, at: -np.ones_like(at), PIECES) == []


def test_ends_of_pieces_count() -> None:
    """A function that jumps is as large as the larger of both sides."""

    def jumps(piece: Piece, at: Array) -> Array:
        return np.full_like(at, piece.low) + at

    last = PIECES[-1]
    assert largest(jumps, PIECES).value == last.low + last.high
