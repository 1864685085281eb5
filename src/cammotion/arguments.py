"""Arguments of another kind than a function says, refused in one sentence."""

import functools
import inspect
import types
import typing
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from cammotion.quantities import InputError, shorten

T = TypeVar("T", bound=Callable[..., Any])
_Reader = Callable[[Any], Any]  # returns what it takes a value for; raises TypeError if it can't

_ANY = (Any, float, int, np.ndarray, object, Callable)  # a number is its Quantity's to refuse
_HOW = {
    "Axes": "the axes of a picture, for example plt.subplots()[1]",
    "ClearanceRule": "a ClearanceRule, for example "
    "ClearanceRule(beyond('die', 19), only_while=within('mill', 0.65))",
    "Condition": "a condition, made with beyond('die', 19) or within('mill', 0.65)",
    "Fit": "a Fit, for example Fit(20, 'H7', 'h6')",
    "FlatFacedCam": "a FlatFacedCam",
    "Indexer": "an Indexer, for example Indexer(38.5, stops=8, time_s=0.75)",
    "int": "a whole number",
    "LeastAcceleration": "what least_acceleration returned",
    "Mapping": "a dictionary",
    "Motion": "a motion, made with motion or indexing_motion, or diagram['die'] of a diagram",
    "MotionLaw": "a motion law, for example LAWS['cycloidal']",
    "Move": "a move, for example Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)",
    "Segment": "a Segment, or make the motion with "
    "motion('die', rise(50, over_deg=55), dwell(100), ...)",
    "TimingDiagram": "a timing diagram, for example TimingDiagram([mill, die], rate_per_hour=2000)",
    "WidestMove": "what widest_move returned",
    "bool": "True or False",
    "float": "a number",
    "str": "a text in quotes",
}


def checked(thing: T) -> T:
    """Let a function or a dataclass refuse arguments of another kind than its annotations say.

    Classes, texts, True and False, and lists and dictionaries of them are checked; a list may be
    anything that can be gone through, and comes in as a tuple. A number is its `Quantity`'s to
    refuse, which knows its unit and its range.

    >>> @checked
    ... def greet(name: str, loudly: bool = False) -> str:
    ...     return name.upper() if loudly else name
    >>> greet("die", loudly="no")
    Traceback (most recent call last):
    cammotion.InputError: greet is given loudly='no': give True or False.
    """
    if isinstance(thing, type):
        thing.__init__ = _checked(thing.__init__, thing.__name__)  # type: ignore[misc]
        return thing
    return typing.cast(T, _checked(thing, thing.__name__))


def _checked(function: Any, title: str) -> Any:
    signature = inspect.signature(function)
    readers: dict[str, tuple[_Reader, str]] = {}

    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        if not readers:
            readers.update(_readers(function))
        bound = signature.bind(*args, **kwargs)  # a wrong name is Python's own to refuse
        for name, value in bound.arguments.items():
            if name in readers and value is not signature.parameters[name].default:
                bound.arguments[name] = _read(*readers[name], value, f"{title} is given {name}")
        return function(*bound.args, **bound.kwargs)

    return call


def _read(reader: _Reader, how: str, value: Any, what: str) -> Any:
    try:
        return reader(value)
    except TypeError:
        raise InputError(f"{what}={shorten(value)}: give {how}.") from None


def _readers(function: Any) -> Iterator[tuple[str, tuple[_Reader, str]]]:
    hints = typing.get_type_hints(inspect.unwrap(function))
    for name, parameter in inspect.signature(function).parameters.items():
        hint = hints.get(name, Any)
        if parameter.kind is inspect.Parameter.VAR_POSITIONAL:
            hint = tuple[hint, ...]  # type: ignore[valid-type]
        if parameter.kind is not inspect.Parameter.VAR_KEYWORD and (reader := _reader(hint)):
            yield name, (reader, " or ".join(_words(hint)))


def _reader(hint: Any) -> _Reader | None:
    """Return what reads a value of a kind, None for a kind that anything may be."""
    origin, inside = typing.get_origin(hint), typing.get_args(hint)
    within = [_reader(one) for one in inside]
    if origin in (types.UnionType, typing.Union):
        return _any_of(within)
    if origin is tuple and inside[1:] != (...,):
        return _row(within)
    if origin in (tuple, list, Sequence, Iterable):
        return _each(within[0])
    if origin is Mapping:
        return _values(within[1])
    is_any = (origin or hint) in _ANY or not isinstance(origin or hint, type)
    return None if is_any else _instance(bool | np.bool_ if hint is bool else origin or hint)


def _instance(kind: Any) -> _Reader:
    def read(value: Any) -> Any:
        if not isinstance(value, kind):
            raise TypeError
        return value

    return read


def _any_of(readers: Sequence[_Reader | None]) -> _Reader | None:
    def read(value: Any) -> Any:
        for reader in readers:
            try:
                return typing.cast(_Reader, reader)(value)
            except TypeError:
                continue
        raise TypeError

    return read if all(readers) else None


def _each(reader: _Reader | None) -> _Reader:
    def read(values: Any) -> Any:
        if isinstance(values, str | bytes):
            raise TypeError
        given = tuple(values)
        return tuple(map(reader, given)) if reader else given

    return read


def _row(readers: Sequence[_Reader | None]) -> _Reader:
    def read(values: Any) -> Any:
        given = _each(None)(values)
        if len(given) != len(readers):
            raise TypeError
        return tuple(
            one(value) if one else value for one, value in zip(readers, given, strict=True)
        )

    return read


def _values(reader: _Reader | None) -> _Reader:
    def read(values: Any) -> Any:
        if not isinstance(values, Mapping):
            raise TypeError
        return {name: reader(value) for name, value in values.items()} if reader else values

    return read


def _words(hint: Any) -> Iterator[str]:
    """Yield in words what may be given for a kind."""
    origin, inside = typing.get_origin(hint), typing.get_args(hint)
    if origin in (types.UnionType, typing.Union):
        for one in inside:
            if one is not type(None):
                yield from _words(one)
    elif origin is tuple and inside[1:] != (...,):
        yield f"{len(inside)} in a row, {', '.join(' or '.join(_words(one)) for one in inside)}"
    elif origin in (tuple, list, Sequence, Iterable):
        yield f"a list, each {' or '.join(_words(inside[0]))}"
    elif origin is Mapping:
        yield f"a dictionary, for each name {' or '.join(_words(inside[1]))}"
    else:
        name = getattr(origin or hint, "__name__", "value")
        yield _HOW.get(name, f"a {name}")
