"""A call that does not fit: one sentence that says how it is called, of every public name."""

import inspect
import pickle
import re
from collections.abc import Callable
from typing import Any

import pytest
from any_input import callables

import cammotion as cm
from cammotion.arguments import checked

HEIR = ("InputError", "WrongAnswerError", "Flight")  # Python's own make them
CALLS = {
    label: function
    for name in cm.__all__
    if name not in HEIR
    for label, function in callables(name, getattr(cm, name))
    if not label.endswith(("__getitem__", "Catalogue.__init__"))
}


def own(function: Callable[..., Any]) -> list[inspect.Parameter]:
    return [p for p in inspect.signature(function).parameters.values() if p.name != "self"]


def call(function: Callable[..., Any], *args: Any, **kwargs: Any) -> Any:
    """Call a function, a method with what could be its object."""
    is_method = "self" in inspect.signature(function).parameters
    return function(*([object()] if is_method else []), *args, **kwargs)


def test_there_are_many() -> None:
    assert len(CALLS) > 280


@pytest.mark.parametrize("label", CALLS)
def test_a_name_too_many_and_a_value_too_many_are_told(label: str) -> None:
    function = CALLS[label]
    if not any(each.kind is inspect.Parameter.VAR_KEYWORD for each in own(function)):
        with pytest.raises(cm.InputError, match=r"Write [\w ]+\(.*\)\.$") as refusal:
            call(function, odd_one=1)
        assert "odd_one" in str(refusal.value) or "takes no arguments" in str(refusal.value)
        assert len(str(refusal.value)) < 700
    if not any(each.kind is inspect.Parameter.VAR_POSITIONAL for each in own(function)):
        with pytest.raises(cm.InputError, match=r" takes .*, and is given 40\. Write "):
            call(function, *range(40))


@pytest.mark.parametrize("label", CALLS)
def test_what_is_missing_is_told(label: str) -> None:
    named = [p for p in own(CALLS[label]) if p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)]
    if needed := [each.name for each in named if each.default is each.empty]:
        with pytest.raises(cm.InputError, match=f" needs {' and '.join(needed)}. Write "):
            call(CALLS[label])


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (
            lambda: cm.rise(50, 55),  # type: ignore[call-arg]
            "rise takes 1 value without a name, and is given 2. "
            "Write rise(stroke_mm, over_deg=..., law=...).",
        ),
        (
            lambda: cm.rise(50, overdeg=55),  # type: ignore[call-arg]
            "There is no argument 'overdeg': did you mean 'over_deg'? "
            "Write rise(stroke_mm, over_deg=..., law=...).",
        ),
        (
            lambda: cm.indexing_time(55, rate=2000),  # type: ignore[call-arg]
            "There is no argument 'rate': did you mean 'rate_per_hour'? "
            "Write indexing_time(angle_deg, rate_per_hour).",
        ),
        (
            lambda: cm.indexing_time(55),  # type: ignore[call-arg]
            "indexing_time needs rate_per_hour. Write indexing_time(angle_deg, rate_per_hour).",
        ),
        (
            lambda: cm.indexing_motion("mill", cm.rise(5, over_deg=180), cm.dwell(180)),  # type: ignore[call-arg]
            "indexing_motion needs stops. Write indexing_motion(name, *parts, stops=..., "
            "start_deg=..., start_mm=...).",
        ),
        (
            lambda: cm.motion("a", cm.dwell(360), name="b"),  # type: ignore[misc]
            "motion is given name twice. Write motion(name, *parts, start_deg=..., start_mm=...).",
        ),
        (
            lambda: cm.dwell(55, angle_deg=5),  # type: ignore[misc]
            "dwell is given angle_deg twice. Write dwell(angle_deg).",
        ),
        (
            lambda: cm.EXAMPLE.die.position_mm(170, 2000),  # type: ignore[call-arg]
            "position_mm takes 1 value, and is given 2. Write position_mm(angle_deg).",
        ),
        (
            lambda: cm.LAWS["cubic"](0.5, 1, 2),  # type: ignore[call-arg]
            "law takes 2 values, and is given 3. Write law(x, derivative=...).",
        ),
        (
            lambda: cm.motion(start_deg=20),  # type: ignore[call-arg]
            "motion needs name. Write motion(name, *parts, start_deg=..., start_mm=...).",
        ),
        (lambda: cm.progress(1), "progress takes no values, and is given 1. Write progress()."),  # type: ignore[call-arg]
    ],
)
def test_a_natural_slip_is_told_in_a_sentence(wrong: Callable[[], Any], said: str) -> None:
    with pytest.raises(cm.InputError) as refusal:
        wrong()
    assert str(refusal.value) == said
    assert isinstance(refusal.value, TypeError)  # as usual, for who catches that


def test_a_fault_inside_stays_what_it_is() -> None:
    @checked
    class Odd:
        def __init__(self, number: int) -> None:
            self.number = number

        def broken(self) -> str:
            return "1" + self.number  # type: ignore[operator, no-any-return]

    with pytest.raises(TypeError, match="concatenate") as fault:
        Odd(1).broken()
    assert not isinstance(fault.value, cm.InputError)


def test_a_public_function_can_be_pickled() -> None:
    assert pickle.loads(pickle.dumps(cm.indexing_time)) is cm.indexing_time  # noqa: S301


@pytest.mark.parametrize("label", CALLS)
def test_help_shows_kinds_by_their_short_names(label: str) -> None:
    shown = str(inspect.signature(CALLS[label]))
    assert not re.search(r"numpy|typing|_Supports|[a-z]\.[A-Za-z]", shown)
    assert len(shown) < 550


def test_help_shows_usual_functions_in_a_line() -> None:
    assert str(inspect.signature(cm.indexing_time)) == (
        "(angle_deg: ArrayLike, rate_per_hour: ArrayLike) -> Any"
    )
    assert str(inspect.signature(cm.TimingDiagram.position_mm)) == (
        "(self, motion: str | Motion, angle_deg: ArrayLike | None = None, *, "
        "time_s: ArrayLike | None = None) -> Any"
    )
    lengths = sorted(len(str(inspect.signature(function))) for function in CALLS.values())
    assert lengths[int(0.75 * len(lengths))] <= 100
