"""Arguments of another kind than a function says, refused in one sentence."""

import functools
import inspect
import math
import types
import typing
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from cammotion.arguments.calls import bind, called
from cammotion.arguments.signatures import readable
from cammotion.quantities import InputError, is_real, shorten

T = TypeVar("T", bound=Callable[..., Any])
_Reader = Callable[[Any], Any]  # returns what it takes a value for; raises TypeError if it can't
_Item = Callable[[Any, object], Any]  # the same for a value at a place

_ANY = (Any, float, int, np.ndarray, object)  # a number is its Quantity's to refuse
_EXAMPLE = ", for example "
_HOW = {
    "Axes": "the axes of a picture, for example plt.subplots()[1]",
    "ClearanceRule": "a ClearanceRule, for example "
    "ClearanceRule(beyond('die', 19), only_while=within('mill', 0.65))",
    "Condition": "a condition, made with beyond('die', 19) or within('mill', 0.65)",
    "Any": "anything",
    "Callable": "a function",
    "RollerFollower": "a TranslatingRoller or a SwingingRoller, for example TranslatingRoller(10)",
    "Rule": "a ClearanceRule or a DistanceRule, for example "
    "ClearanceRule(beyond('die', 19), only_while=within('mill', 0.65))",
    "DiscCam": "a RollerCam or a FlatFacedCam",
    "Expr": "an expression of SymPy, for example 3 * cammotion.x**2",
    "Fit": "a Fit, for example Fit('40 H7/g6')",
    "FlatFacedCam": "a FlatFacedCam",
    "Flights": "what follower_flights returned",
    "FollowerLoad": "a FollowerLoad, for example "
    "FollowerLoad(mass_kg=12, stiffness_N_per_mm=5, preload_N=100)",
    "Indexer": "an Indexer, for example Indexer(38.5, stops=8, time_s=0.75)",
    "int": "a whole number",
    "LeastAcceleration": "what least_acceleration returned",
    "Machine": "a Machine, for example what read_machine returned",
    "Mapping": "a dictionary",
    "Motion": "a motion, made with motion or indexing_motion, or diagram['die'] of a diagram",
    "MotionLaw": "a motion law, for example LAWS['cycloidal']",
    "Move": "a move, for example Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)",
    "Segment": "a Segment, or make the motion with "
    "motion('die', rise(50, over_deg=55), dwell(100), ...)",
    "TimingDiagram": "a timing diagram, for example TimingDiagram([mill, die], rate_per_hour=2000)",
    "WidestMove": "what widest_move returned",
    "bool": "True or False",
    "float": "a finite number",
    "str": "a text in quotes",
}


class _InsideError(TypeError):
    """A value at a place of what was given is of another kind than `how` says."""

    def __init__(self, place: str, value: object, how: str) -> None:
        super().__init__(place)
        self.place, self.value, self.how = place, value, how


def checked(thing: T) -> T:
    """Let a function or a dataclass refuse arguments of another kind than its annotations say.

    A call that does not fit is refused, too, of a class also that of a method.
    Classes, texts, True and False, and lists and dictionaries of them are checked; a list may be
    anything that can be gone through, and comes in as a tuple. A number that is an argument itself
    is its `Quantity`'s to refuse, which knows its unit and its range.

    >>> @checked
    ... def greet(name: str, loudly: bool = False) -> str:
    ...     return name.upper() if loudly else name
    >>> greet("die", loudly="no")
    Traceback (most recent call last):
    cammotion.InputError: greet is given loudly='no': give True or False.
    """
    if isinstance(thing, type):
        called(thing)
        thing.__init__ = _checked(thing.__init__, thing.__name__)  # type: ignore[misc]
        return thing
    return typing.cast(T, _checked(thing, thing.__name__))


def _checked(function: Any, title: str) -> Any:
    signature = inspect.signature(function)
    readers: dict[str, tuple[_Reader, str]] | None = None  # made when it is first called

    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        nonlocal readers
        if readers is None:
            readers = dict(_readers(function))
        said = type(args[0]).__name__ if title == "__init__" else title
        bound = bind(signature, said, args, kwargs)
        for name, value in bound.arguments.items():
            if name in readers and value is not signature.parameters[name].default:
                bound.arguments[name] = _read(*readers[name], value, f"{said} is given {name}")
        return function(*bound.args, **bound.kwargs)

    call.refuses_calls = True  # type: ignore[attr-defined]  # a call that does not fit, by bind
    call.__signature__ = readable(function)  # type: ignore[attr-defined]
    return call


def _read(reader: _Reader, how: str, value: Any, what: str) -> Any:
    try:
        return reader(value)
    except _InsideError as wrong:
        what, how, value = what + wrong.place, wrong.how, wrong.value
    except TypeError:
        pass
    if _HOW["TimingDiagram"] in how and hasattr(value, "diagram"):  # of a machine, of what is found
        how = "its timing diagram, with .diagram behind it"
    raise InputError(f"{what}={shorten(value)}: give {how}.")


def _readers(function: Any) -> Iterator[tuple[str, tuple[_Reader, str]]]:
    hints = typing.get_type_hints(inspect.unwrap(function))
    for name, parameter in inspect.signature(function).parameters.items():
        hint = hints.get(name, Any)
        if parameter.kind is inspect.Parameter.VAR_POSITIONAL:
            hint = tuple[hint, ...]  # type: ignore[valid-type]
        if parameter.kind is not inspect.Parameter.VAR_KEYWORD and (reader := _reader(hint)):
            yield name, (reader, _once(_words(hint)))


def _reader(hint: Any) -> _Reader | None:
    """Return what reads a value of a kind, None for a kind that anything may be."""
    origin, inside = typing.get_origin(hint), typing.get_args(hint)
    if origin in (types.UnionType, typing.Union):
        by_keys_first = sorted(
            inside, key=lambda one: getattr(one, "__origin__", None) is not Mapping
        )
        return _any_of([_reader(one) for one in by_keys_first])
    if origin is tuple and inside[1:] != (...,):
        return _row([_item(one) for one in inside])
    if origin in (tuple, list, Sequence, Iterable):
        return _each(_item(inside[0]))
    if origin is Mapping:
        return _values(_item(inside[1]))
    kind = origin or hint
    if kind is Callable:
        return _callable
    is_any = kind in _ANY or not isinstance(kind, type) or getattr(kind, "_is_protocol", False)
    return None if is_any else _instance(bool | np.bool_ if hint is bool else kind)


def _item(hint: Any) -> _Item:
    """Return what reads a value that has a place in a list or a dictionary."""
    reader = _number if hint is float else _reader(hint)

    def read(value: Any, place: object) -> Any:
        try:
            return reader(value) if reader else value
        except _InsideError as wrong:
            raise _InsideError(f"[{place!r}]{wrong.place}", wrong.value, wrong.how) from None
        except TypeError:
            raise _InsideError(f"[{place!r}]", value, _once(_words(hint))) from None

    return read


def _number(value: Any) -> float:
    if not is_real(value):
        raise TypeError
    try:
        is_finite = math.isfinite(value)
    except OverflowError:  # 10**400
        raise TypeError from None
    if not is_finite:
        raise TypeError
    return value if isinstance(value, int | float) else float(value)


def _instance(kind: Any) -> _Reader:
    def read(value: Any) -> Any:
        if not isinstance(value, kind):
            raise TypeError
        return value

    return read


def _callable(value: Any) -> Any:
    if not callable(value):
        raise TypeError
    return value


def _any_of(readers: Sequence[_Reader | None]) -> _Reader | None:
    def read(value: Any) -> Any:
        refusal = TypeError()
        for reader in readers:
            try:
                return typing.cast(_Reader, reader)(value)
            except _InsideError as wrong:
                refusal = wrong
                if isinstance(value, Mapping):  # its keys are no list
                    break
            except TypeError:
                continue
        raise refusal

    return read if all(readers) else None


def _each(item: _Item) -> _Reader:
    def read(values: Any) -> Any:
        return tuple(item(value, place) for place, value in enumerate(_several(values)))

    return read


def _row(items: Sequence[_Item]) -> _Reader:
    def read(values: Any) -> Any:
        given = _several(values)
        if len(given) != len(items):
            raise TypeError
        return tuple(
            item(value, place) for place, (item, value) in enumerate(zip(items, given, strict=True))
        )

    return read


def _values(item: _Item) -> _Reader:
    def read(values: Any) -> Any:
        if not isinstance(values, Mapping):
            raise TypeError
        return {name: item(value, name) for name, value in values.items()}

    return read


def _several(values: Any) -> tuple[Any, ...]:
    if isinstance(values, str | bytes):
        raise TypeError
    return tuple(values)


def _once(words: str) -> str:
    """Return words in which an example is not said again."""
    for how in _HOW.values():
        if _EXAMPLE in how:
            example = how[how.index(_EXAMPLE) :]
            first, said, more = words.partition(example)
            words = first + said + more.replace(example, "")
    return words


def _words(hint: Any) -> str:
    """Return in words what may be given for a kind."""
    if hint == ArrayLike:
        return "a number or a list of numbers"
    origin, inside = typing.get_origin(hint), typing.get_args(hint)
    each = [_words(one) for one in inside if one not in (..., types.NoneType)]
    if origin in (types.UnionType, typing.Union):
        return (", or " if any("," in one for one in each) else " or ").join(each)
    if origin is tuple and inside[1:] != (...,):
        kinds = [f"each {each[0]}"] if len({*inside}) == 1 else each
        return ", ".join([f"{len(inside)} values", *([] if {*inside} == {Any} else kinds)])
    if origin in (tuple, list, Sequence, Iterable):
        return f"a list, each {each[0]}"
    if origin is Mapping:
        return f"a dictionary, for each name {each[1]}"
    name = getattr(origin or hint, "__name__", "value")
    return _HOW.get(name, f"a {name}")
