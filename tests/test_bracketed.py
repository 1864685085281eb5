"""What is searched for between samples: the largest of peaks, and arcs narrower than a step."""

import numpy as np
import pytest
from machines import Array

import cammotion as cm
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


def test_no_place_is_sampled_twice() -> None:
    """Of two that differ by rounding one may be higher, and hide the peak beside the other."""
    motion = cm.motion(
        "late",
        *(cm.rise(1, over_deg=1.676435491344), cm.dwell(100)),
        *(cm.return_(1, over_deg=1.676435186642, law="modified trapezoidal"), cm.dwell(256)),
        cm.dwell(0.647129322014),
        start_deg=760.664307961657,
    )
    for piece in motion.curve.pieces:
        places = samples(piece)
        assert (places[0], places[-1]) == (piece.low, piece.high)
        assert np.diff(places).min() > 1e-8 * (piece.high - piece.low)


def test_a_short_piece_late_in_the_turn_is_sampled_as_an_early_one() -> None:
    """What is a place twice is asked of the piece's length, not of its angle."""
    early, late = (
        cm.motion(
            "flick",
            *(cm.rise(1, over_deg=2e-5), cm.dwell(180 - 2e-5), cm.return_(1, over_deg=180)),
            start_deg=start,
        ).curve.pieces[0]
        for start in (0, 720)
    )
    assert samples(late).size == samples(early).size == 33
