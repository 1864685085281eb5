"""The bug hunt of notebook 05: one is right, and the others fail as their reasons say."""

import re
from collections.abc import Callable

import numpy as np
import pytest

import cammotion as cm
from cammotion.quantities import Floats
from cammotion.teaching import bug_hunt
from cammotion.teaching.example import EXAMPLE
from cammotion.teaching.exercise import ChoiceExercise
from cammotion.teaching.lessons import EXERCISES

X = np.linspace(0, 1, 8001)  # the joints, at the eighths, are among the places
STEP = X[1]
NEXT_TO_A_JOINT = 1e-9
PEAKS = {"modified sine": 4 * np.pi**2 / (4 + np.pi), "modified trapezoid": 8 * np.pi / (2 + np.pi)}

(HUNT,) = (e for e in EXERCISES.values() if e.number == "05.6" and isinstance(e, ChoiceExercise))

FAILS: dict[str, set[str]] = {
    "a": {"ends", "peak", "integral"},  # too large by one factor, all of it
    "b": {"peak"},
    "c": {"jumps", "S' = V"},
    "d": {"jumps", "integral"},  # V is right but for its middle: what is lost is in the jumps
    "e": set(),
    "f": {"V' = A"},
}
SPEAKS_OF = {"a": "ends", "b": "peak", "c": "jumps", "d": "jumps", "f": "V' = A"}
WORDS = {
    "ends": r"Where does it end\?",
    "peak": "its peak",
    "jumps": "continuous|jump",
    "S' = V": "V its slope",
    "V' = A": "A the slope of V",
}


def named(letter: str) -> str:
    """Return the law that an implementation says it is."""
    (name,) = re.findall(r"Return the (.*)\.", bug_hunt.SUSPECTS[letter].__doc__ or "")
    return str(name)


def has_right_ends(letter: str) -> bool:
    s, v, _ = bug_hunt.SUSPECTS[letter](np.array([0.0, 1.0]))
    return np.allclose(s, [0, 1], rtol=0, atol=1e-12) and np.allclose(v, 0, rtol=0, atol=1e-12)


def has_no_jumps(letter: str) -> bool:
    """Tell whether S and V are the same on either side of every place."""
    inner = X[1:-1]
    sides = [bug_hunt.SUSPECTS[letter](inner + side * NEXT_TO_A_JOINT) for side in (-1, 1)]
    return all(np.abs(sides[1][n] - sides[0][n]).max() < 1e-7 for n in (0, 1))


def is_slope(of: int, letter: str) -> bool:
    """Tell whether one curve is the slope of the one before, between all neighbours.

    No place is at a joint, so a jump there is left to the other test.
    """
    middles = (X[1:] + X[:-1]) / 2
    h = STEP / 8
    left, right = (bug_hunt.SUSPECTS[letter](middles + side * h)[of] for side in (-1, 1))
    slope = (right - left) / (2 * h)
    return np.allclose(slope, bug_hunt.SUSPECTS[letter](middles)[of + 1], rtol=0, atol=1e-5)


def makes_the_way(letter: str) -> bool:
    """Tell whether the mean velocity is 1, by the midpoints."""
    middles = (X[1:] + X[:-1]) / 2
    return abs(float(np.mean(bug_hunt.SUSPECTS[letter](middles)[1])) - 1) < 1e-6


def has_its_peak(letter: str) -> bool:
    """Tell whether the largest acceleration is that of the law in its name, by its closed form."""
    peak = float(np.abs(bug_hunt.SUSPECTS[letter](X)[2]).max())
    return abs(peak - PEAKS[named(letter)]) < 1e-5


EXAMINATION: dict[str, Callable[[str], bool]] = {
    "ends": has_right_ends,
    "jumps": has_no_jumps,
    "S' = V": lambda letter: is_slope(0, letter),
    "V' = A": lambda letter: is_slope(1, letter),
    "integral": makes_the_way,
    "peak": has_its_peak,
}


def failed(letter: str) -> set[str]:
    return {name for name, passes in EXAMINATION.items() if not passes(letter)}


@pytest.mark.parametrize("letter", bug_hunt.SUSPECTS)
def test_each_fails_in_the_examination_what_it_is_made_to_fail(letter: str) -> None:
    assert failed(letter) == FAILS[letter]


def test_exactly_one_passes_and_the_exercise_says_so() -> None:
    (right,) = (letter for letter in bug_hunt.SUSPECTS if not failed(letter))
    assert right == HUNT.answer
    assert HUNT.judge(right, EXAMPLE).state == "right"
    assert max(map(len, FAILS.values())) > 1
    assert "each of the others fails at least one." in HUNT.right


@pytest.mark.parametrize("letter", SPEAKS_OF)
def test_the_reason_speaks_of_a_test_that_it_fails(letter: str) -> None:
    assert HUNT.reasons.keys() == SPEAKS_OF.keys()
    said = HUNT.judge(letter, EXAMPLE).text
    spoken_of = {test for test, words in WORDS.items() if re.search(words, said)}
    assert SPEAKS_OF[letter] in spoken_of <= FAILS[letter]


def test_the_words_of_praise_in_the_reasons_are_true() -> None:
    for letter in "cd":
        assert "begins and ends well" in HUNT.reasons[letter]
        assert has_right_ends(letter)
    assert "true to itself" in HUNT.reasons["b"]
    assert failed("b") == {"peak"}
    assert "S and V are right" in HUNT.reasons["f"]
    assert "just after the middle" in HUNT.reasons["f"]
    law = cm.LAWS[named("f")]
    s, v, a = bug_hunt.law_f(X)
    after = (X > 1 / 2) & (X <= 5 / 8)
    np.testing.assert_allclose(a * np.where(after, -1, 1), law(X, derivative=2), rtol=0, atol=1e-9)
    np.testing.assert_allclose(s, law(X), rtol=0, atol=1e-12)
    np.testing.assert_allclose(v, law(X, derivative=1), rtol=0, atol=1e-11)


def test_the_right_one_is_the_modified_sine_of_the_package() -> None:
    curves: tuple[Floats, ...] = bug_hunt.SUSPECTS[HUNT.answer](X)
    for derivative, curve in enumerate(curves):
        expected = cm.LAWS["modified sine"](X, derivative=derivative)
        np.testing.assert_allclose(curve, expected, rtol=0, atol=1e-12)


def test_the_options_name_the_laws_that_the_docstrings_name() -> None:
    assert HUNT.options == {
        letter: f"law_{letter}, a {named(letter)}" for letter in bug_hunt.SUSPECTS
    }
    assert {named(letter) for letter in bug_hunt.SUSPECTS} == PEAKS.keys()


def test_the_modified_trapezoid_is_right_up_to_where_it_is_made_to_fail() -> None:
    x = np.linspace(0, 3 / 8, 50)
    right = (cm.LAWS["modified trapezoid"](x, order) for order in range(3))
    for curve, known in zip(bug_hunt.law_c(x), right, strict=True):
        np.testing.assert_allclose(curve, known, atol=1e-12)
