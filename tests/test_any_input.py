"""A result or an InputError, whatever is given to a public name; none takes more than seconds.

What comes of the calls that fit is short, equal to what is made of the same, and can be sent on.
"""

import contextlib
import dataclasses
import inspect
import io
import pickle
import time
import traceback
import warnings
from collections.abc import Iterator, Mapping
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from any_input import ODD, Recorded, run_examples
from crowds import draw
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.text import Text

import cammotion as cm
from cammotion.rules.rule import Rule

SEED, VALUES = 20261127, 2  # for each argument
SLOWEST_S = 20
APART = {"again", "ask", "check", "check_setup", "choose", "hint", "predict", "progress", "variant"}
"""What speaks to the learner has a test of its own, test_exercises_fuzz.py."""


@pytest.fixture(scope="module")
def examples() -> tuple[list[Recorded], str]:
    """Run the examples, once for all tests of this file; pytest's own run of them is another."""
    return run_examples()


@pytest.fixture(scope="module")
def calls(examples: tuple[list[Recorded], str]) -> list[Recorded]:
    return [call for call in examples[0] if call.name not in APART]


def test_each_example_of_a_docstring_comes_to_what_it_says(
    examples: tuple[list[Recorded], str],
) -> None:
    calls, failed = examples
    assert not failed, failed
    assert len(calls) > 350


def wrong(call: Recorded, parameter: str, value: object) -> str:
    """Make a call with an odd value, and return what is wrong with what came of it."""
    begun = time.perf_counter()
    try:
        with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", message="The points of the law")
            repr(call.with_value(parameter, value))
    except cm.InputError as refusal:
        if len(str(refusal)) > 1000:
            return f"a sentence of {len(str(refusal))} characters"
    except Exception:
        return traceback.format_exc(limit=-2)
    finally:
        plt.close("all")
    took = time.perf_counter() - begun
    return f"took {took:.0f} s" if took > SLOWEST_S else ""


def test_a_result_or_a_sentence(
    calls: list[Recorded], tmp_path: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(str(tmp_path))
    rng, found = np.random.default_rng(SEED), []
    tries = {
        (call.name, parameter): (call, parameter)
        for call in calls
        for parameter in call.arguments
        if parameter != "self"
    }
    for call, parameter in tries.values():
        for at in rng.choice(len(ODD), VALUES, replace=False):
            value = ODD[at]
            if parameter == "progress" and callable(value):  # its own errors are the user's
                continue
            if fault := wrong(call, parameter, value):
                found.append(f"{call.name}({parameter}={value!r:.60}): {fault}")
    assert len(tries) > 500
    assert not found, f"{len(found)} faults:\n" + "\n".join(found[:20])


def test_every_public_name_with_arguments_is_tried(calls: list[Recorded]) -> None:
    tried = {call.name.split(".")[0] for call in calls}
    functions = {
        name for name in cm.__all__ if callable(getattr(cm, name)) and name[0].islower()
    } - {"x"}
    assert functions - tried - APART == set()


def names_in(value: object) -> set[str]:
    """Return the names of the motions of diagrams that stand somewhere in an argument."""
    if isinstance(value, cm.Camshaft | cm.Machine):
        return {*value.diagram.names}
    if isinstance(value, Mapping):
        return names_in([*value.values()])
    if isinstance(value, list | tuple):
        return {name for each in value for name in names_in(each)}
    return {*value.names} if isinstance(value, cm.TimingDiagram) else set()


def respelled(value: Any, names: set[str]) -> Any:
    """Return an argument with the names of motions in capitals."""
    if isinstance(value, str):
        return value.upper() if value in names else value
    if isinstance(value, Rule):
        return value.renamed({name: name.upper() for name in value.motions})
    if isinstance(value, Mapping):
        return {respelled(key, names): respelled(each, names) for key, each in value.items()}
    if type(value) in (list, tuple):
        return type(value)(respelled(each, names) for each in value)
    return value


def said_of(result: Any) -> object:
    """Return what can be seen of a result."""
    if isinstance(result, Axes):
        words = [text.get_text() for text in result.figure.findobj(Text)]
        return words, [np.asarray(line.get_xydata()).tolist() for line in result.lines]
    return getattr(result, "text", None) or repr(result)


def test_names_may_be_in_any_case(
    calls: list[Recorded], tmp_path: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each name with arguments that name motions of a diagram, with these names in capitals."""
    monkeypatch.chdir(str(tmp_path))
    tried = set()
    for call in calls:
        names = names_in([*call.arguments.values()])
        given = {name: value for name, value in call.arguments.items() if name != "self"}
        other = respelled(given, names)
        named = tuple(name for name in given if repr(other[name]) != repr(given[name]))
        is_new = named and (call.name, named) not in tried
        if is_new and call.made and call.name != "write_chart":  # which writes into a folder
            assert said_of(call.with_values(other)) == said_of(call.with_values({})), call.name
            tried.add((call.name, named))
        plt.close("all")
    assert len({name for name, _ in tried}) > 15, tried


def test_a_number_of_any_kind_makes_the_same_thing(calls: list[Recorded]) -> None:
    """A dataclass keeps and computes the same, with a Decimal or a Fraction for each number."""
    found, tried = [], set()
    for call in calls:
        if not (dataclasses.is_dataclass(call.function) and call.made):
            continue
        for name, value in call.arguments.items():
            if not is_measured(call, name) or isinstance(value, bool):
                continue
            usual, text = computed(call.made[0]), str(value)
            tried.add(type(call.made[0]).__name__)
            for number in (Decimal(text), Fraction(text)):
                if computed(call.with_value(name, number)) != usual:
                    found.append(f"{call.name}({name}={number!r})")
    assert not found, "\n".join(found)
    assert tried > {"Disc", "Indexer", "Move", "OwnInertia", "PointMasses", "ProcessForce"}


def is_measured(call: Recorded, name: str) -> bool:
    """Whether an argument is a number; what of a live figure is an expression stays as it is."""
    value, module = call.arguments[name], call.function.__module__
    return isinstance(value, int | float) and not (
        module.startswith("cammotion.views.live") and name != "height"
    )


def computed(thing: Any) -> list[object]:
    """Return all that a thing keeps and computes without being asked with an argument."""
    kept = [field.name for field in dataclasses.fields(thing)]
    values: list[object] = []
    for name in {*kept, *dir(type(thing))}:
        if name.startswith("_"):
            continue
        try:
            value = getattr(thing, name)
        except cm.InputError as refused:
            value = str(refused)
        if not callable(value):
            values.append((name, type(value), repr(value).partition(" at 0x")[0]))
    return sorted(values, key=repr)


SHOWN = 150
SAID = {"Improvements", "LeastPeak", "MillAndDie", "Optimised", "Panel"}
"""What is shown of these is a text to be read, or the lines of a picture one by one."""
NOT_SENT = {"NumberControl", "InputError", "WrongAnswerError"}


def made(calls: list[Recorded]) -> Iterator[object]:
    """Yield what the calls of the docstrings come to, and what none of them makes."""
    die, chain = cm.EXAMPLE.die, cm.tuned_mass(12, 0.02)
    results = [result for call in calls for result in call.made]
    results += [cm.StartResponse(chain, die, 2000), cm.SteadyResponse(chain, die, 2000)]
    results += [cm.Undercut(10, 20, 15, 0.1), cm.EXAMPLE]
    for result in results:
        several = isinstance(result, tuple | cm.Improvements | cm.Flights)
        yield from [result, *result] if several else [result]


@pytest.fixture(scope="module")
def things(calls: list[Recorded]) -> list[object]:
    """Return an object of each public class."""
    public = {getattr(cm, name) for name in cm.__all__ if inspect.isclass(getattr(cm, name))}
    return [*{type(each): each for each in made(calls) if type(each) in public}.values()]


def test_there_is_one_of_each(things: list[object]) -> None:
    classes = {name for name in cm.__all__ if inspect.isclass(getattr(cm, name))}
    assert {type(each).__name__ for each in things} == classes - NOT_SENT


def test_what_is_shown_is_short(things: list[object]) -> None:
    long = {type(each).__name__ for each in things if len(repr(each)) > SHOWN}
    assert long <= SAID
    assert all(len(repr(each)) < 4 * SHOWN for each in things)
    assert not [each for each in things if " object at 0x" in repr(each)]


def test_what_is_sent_to_another_process_is_the_same(things: list[object]) -> None:
    for each in things:
        sent = pickle.loads(pickle.dumps(each))  # noqa: S301
        assert sent == each, type(each).__name__
        assert repr(sent) == repr(each)


def test_eight_mechanisms_are_shown_in_a_line_too() -> None:
    diagram = draw(np.random.default_rng(SEED), 8).diagram
    shaft = cm.Camshaft(diagram, dict.fromkeys(diagram.names, cm.FollowerLoad(mass_kg=1)))
    for each in (diagram, shaft, cm.Machine("eight", diagram)):
        assert len(repr(each)) <= 1.2 * SHOWN
