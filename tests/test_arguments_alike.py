"""Arguments are alike wherever they are asked for: their units, their kinds and their order.

How each function is called is kept in a table: run this file to write it anew, and read what has
changed.
"""

import inspect
import re
import types
import typing
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from any_input import callables
from numpy.typing import ArrayLike, NDArray

import cammotion as cm

KEPT = Path(__file__).parent / "data" / "calls.txt"
LESSONS = ("MillAndDie",)  # the example's numbers are those of its lessons, in their words
FUNCTIONS = {
    label: inspect.unwrap(function)
    for name in cm.__all__
    if not issubclass(type(getattr(cm, name)), type) or not issubclass(getattr(cm, name), Exception)
    for label, function in callables(name, getattr(cm, name))
    if not label.startswith(LESSONS)
}

UNIT = re.compile(
    r"_(um|mm|deg|s|kg|N|Hz|N_m|kg_m2|m_per_s|m_per_s[23]|per_hour|kg_per_m3|N_per_mm2?|mm2|N_s_per_mm)$"
)
WITHOUT_UNIT = {
    "a ratio, a share, a number of turns or of swings": (
        "amount damping_ratio factor gap magnify poisson ratios restitution safety share shares "
        "smoothing swings times turns cycles"
    ),
    "of a motion law, which has none": "b c d end end_slopes places s start step ways x",
    "in the unit that is said beside it": (
        "after at_most before bound cycle high largest limit low peaks position tried value weights"
    ),
    "arcs of the turn, always pairs in deg": "arc over still",
    "pairs of two quantities": "corners curves named points",
    "a symbol with its ends": "controls span",
    "velocity and acceleration that are results, always in m/s and m/s2": (
        "velocity velocity_weights acceleration acceleration_weights"
    ),
    "a place of the response: s of a move, deg of a turn": "at",
    "the rank of a harmonic": "rank",
    "a unit itself": "seconds",
    "of a picture": "height step words x x_ticks y_ticks",
}
BARE = {name for names in WITHOUT_UNIT.values() for name in names.split()}

TWO_MEANINGS = {
    "after": "a machine, or the peak that an improvement has",
    "before": "as after",
    "cam": "a cam, or of a polydyne the law of it",
    "fit": "how a curve goes through points, or what has been fitted",
    "flights": "what follower_flights found, or each of them",
    "found": "results, of least_peak or of least_acceleration",
    "mass": "which mass of a chain, or of a polydyne the law of it",
    "number": "of an exercise, 12.1, or of harmonics",
    "parts": "of a motion, or of a rotor",
    "points": "how many, or those of a picture",
    "s": "values of a law, or its expression",
    "span": "a piece of the turn, or a variable with its ends",
    "start": "where something begins, of a choice its name",
    "x": "values of a law, or in a picture what an axis is about",
}


def parameters(function: Callable[..., Any]) -> dict[str, inspect.Parameter]:
    found = inspect.signature(function).parameters
    return {name: each for name, each in found.items() if name not in ("self", "args", "kwargs")}


def kinds(hint: Any) -> set[Any]:
    """Return what a hint is about: a thing, whether it is one, several, or several by name."""
    if hint in (ArrayLike, ArrayLike | None, int):
        return {float}
    origin, inside = typing.get_origin(hint), typing.get_args(hint)
    if origin in (np.ndarray, NDArray):  # NumPy 2.5 has an alias of its own
        return {float}
    if origin is typing.Literal:
        return {str}
    if origin in (typing.Union, types.UnionType):
        return set().union(*(kinds(each) for each in inside)) - {types.NoneType}
    if origin in (tuple, list, Sequence, Iterable):
        return set().union(*(kinds(each) for each in inside if each is not Ellipsis))
    return kinds(inside[1]) if origin is Mapping else {origin or hint}


def uses() -> dict[str, dict[str, Any]]:
    """Return each name of an argument, with the hint that it has in each function."""
    found: dict[str, dict[str, Any]] = defaultdict(dict)
    for label, function in FUNCTIONS.items():
        hints = typing.get_type_hints(function)
        for name in parameters(function):
            found[name][label] = hints.get(name, Any)
    return found


USES = uses()


def is_quantity(hint: Any) -> bool:
    """Whether it is a number, and not only a whole one, which counts something."""
    is_any = hint in (ArrayLike, ArrayLike | None)
    text = str(hint).replace(str(ArrayLike), "")  # in which some NumPys spell out float
    return is_any or (float in kinds(hint) and "float" in text)


def is_kind_of(one: type, other: type) -> bool:
    return not getattr(other, "_is_protocol", False) and issubclass(one, other)


def fit_together(one: set[Any], other: set[Any]) -> bool:
    """Whether there is a thing that both arguments take."""
    if one & other or Any in one | other:
        return True
    classes = [[kind for kind in each if isinstance(kind, type)] for each in (one, other)]
    return any(is_kind_of(a, b) or is_kind_of(b, a) for a in classes[0] for b in classes[1])


def clashes(hints: Mapping[str, Any]) -> Iterator[str]:
    for (one, first), (other, second) in combinations(hints.items(), 2):
        if not fit_together(kinds(first), kinds(second)):
            yield f"{one} takes {first}, {other} takes {second}"


def test_there_are_many() -> None:
    assert len(FUNCTIONS) > 280
    assert len(USES) > 230


@pytest.mark.parametrize("name", USES)
def test_a_quantity_says_its_unit(name: str) -> None:
    whose = [label for label, hint in USES[name].items() if is_quantity(hint)]
    assert not whose or UNIT.search(name) or name in BARE, f"{name} of {whose}"


@pytest.mark.parametrize("name", USES)
def test_an_argument_is_of_one_kind(name: str) -> None:
    assert name in TWO_MEANINGS or not [*clashes(USES[name])]


def test_what_is_left_out_is_still_there() -> None:
    """A name that is gone, or alike by now, is no exception any more."""
    quantities = {name for name, hints in USES.items() if any(map(is_quantity, hints.values()))}
    assert quantities >= BARE
    assert {name for name, hints in USES.items() if [*clashes(hints)]} == {*TWO_MEANINGS}


def test_arguments_come_in_one_order() -> None:
    placed: dict[tuple[str, str], str] = {}
    for label, function in FUNCTIONS.items():
        names = [
            name
            for name, each in parameters(function).items()
            if each.kind in (each.POSITIONAL_ONLY, each.POSITIONAL_OR_KEYWORD)
        ]
        for pair in combinations(names, 2):
            placed[pair] = label
    turned = {pair: placed[pair] for pair in placed if pair[::-1] in placed}
    assert not turned


def test_a_mechanism_is_asked_about_by_its_name_or_itself() -> None:
    for label, hint in USES["motion"].items():
        assert cm.Motion in kinds(hint), label
        if "diagram" in parameters(FUNCTIONS[label]) or label.startswith("TimingDiagram."):
            is_new = label in ("TimingDiagram.with_motion", "LeastAcceleration.__init__")
            assert is_new or str in kinds(hint), label


def calls() -> Iterator[str]:
    """Yield a line for each function: its arguments, which by name alone, and what else is taken.

    What is made at each call, or is a thing of the package, is left out with its address.
    """
    for label, function in FUNCTIONS.items():
        bare = [each.replace(annotation=each.empty) for each in parameters(function).values()]
        yield re.sub(r"=<[^>]*>+", "=...", f"{label}{inspect.Signature(bare)}")


def test_every_function_is_called_as_it_is_kept() -> None:
    assert [*calls()] == KEPT.read_text("utf-8").splitlines()


if __name__ == "__main__":
    KEPT.write_text("\n".join(calls()) + "\n", "utf-8", newline="")
