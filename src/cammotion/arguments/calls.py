"""A call that does not fit a function, refused in one sentence that says how it is called."""

import functools
import inspect
import re
import sys
import typing
import warnings
from collections.abc import Callable, Mapping, Sequence
from itertools import takewhile
from traceback import walk_stack
from typing import Any, TypeVar

from cammotion.arguments.signatures import readable
from cammotion.quantities import InputError, UnknownNameError, one_of, plural

T = TypeVar("T", bound=Callable[..., Any])

_PLACED = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
_ANY_NUMBER = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
_PACKAGE = "cammotion."
_PER_MINUTE = ("rate_per_minute", "per_minute", "cycles_per_minute", "strokes_per_minute", "rpm")


class CallError(InputError, TypeError):
    """A call that does not fit what is called: a TypeError too, as usual."""


def called(thing: T) -> T:
    """Let a function, or a class and its public methods, refuse a call that does not fit.

    A fault inside stays what it is. Each public name is `called` when it is first asked for.

    >>> @called
    ... def greet(name: str) -> str:
    ...     return f"Hello {name}"
    >>> greet("die", 2)
    Traceback (most recent call last):
    cammotion.arguments.calls.CallError: greet takes 1 value, and is given 2. Write greet(name).
    """
    if isinstance(thing, type):
        for kind in thing.__mro__:
            if kind.__module__.startswith(_PACKAGE):
                _dress(kind)
        return thing
    if not inspect.isfunction(thing) or _is_dressed(thing):
        return thing
    fitting = _fitting(thing, thing.__name__)
    setattr(sys.modules[thing.__module__], thing.__name__, fitting)  # where pickle looks for it
    return typing.cast(T, fitting)


def bind(
    signature: inspect.Signature, title: str, args: Sequence[Any], kwargs: Mapping[str, Any]
) -> inspect.BoundArguments:
    """Return the arguments by their names; raises CallError if they do not fit."""
    try:
        return signature.bind(*args, **kwargs)
    except TypeError:
        wrong = _wrong(signature, title, args, kwargs)
    raise CallError(f"{wrong} Write {title}({', '.join(map(_shown, _own(signature)))}).")


def warn(text: str) -> None:
    """Warn of what was given, in the line outside of the package that has called it."""
    frames = (frame for frame, _ in walk_stack(inspect.currentframe()))
    names = (f"{frame.f_globals.get('__name__')}." for frame in frames)
    inside = takewhile(lambda name: name.startswith(_PACKAGE), names)
    warnings.warn(text, UserWarning, stacklevel=1 + len([*inside]))


def _is_dressed(function: Any) -> bool:
    return getattr(function, "refuses_calls", False)


def _dress(kind: type) -> None:
    for name, method in [*vars(kind).items()]:
        if _is_public(name) and inspect.isfunction(method) and not _is_dressed(method):
            setattr(kind, name, _fitting(method, _title(kind, name)))


def _fitting(function: Any, title: str) -> Any:
    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        try:
            return function(*args, **kwargs)
        except TypeError:
            bind(inspect.signature(function), title, args, kwargs)
            raise

    call.refuses_calls = True  # type: ignore[attr-defined]  # it is dressed once
    call.__signature__ = readable(function)  # type: ignore[attr-defined]
    return call


def _is_public(name: str) -> bool:
    return not name.startswith("_") or name in ("__init__", "__call__")


def _title(kind: type, method: str) -> str:
    if method == "__call__":  # law(0.5) for a MotionLaw
        return str(re.findall("[A-Z][a-z]*", kind.__name__)[-1]).lower()
    return kind.__name__ if method == "__init__" else method


def _own(signature: inspect.Signature) -> list[inspect.Parameter]:
    return [each for each in signature.parameters.values() if each.name != "self"]


def _shown(parameter: inspect.Parameter) -> str:
    """Return an argument as it is written: with its name where it has to be, or may be left out."""
    if parameter.kind in _ANY_NUMBER:
        return str(parameter).partition(":")[0]
    is_bare = parameter.kind in _PLACED and parameter.default is parameter.empty
    return parameter.name if is_bare else f"{parameter.name}=..."


def _wrong(
    signature: inspect.Signature, title: str, args: Sequence[Any], kwargs: Mapping[str, Any]
) -> str:
    """Return a sentence on what does not fit."""
    own = _own(signature)
    given = args[len(signature.parameters) - len(own) :]
    named = {each.name: each for each in own if each.kind not in _ANY_NUMBER}
    placed = [each.name for each in own if each.kind in _PLACED]
    if unknown := [name for name in kwargs if name not in named]:
        return _unknown(title, unknown[0], [*named])
    takes_any = any(each.kind is each.VAR_POSITIONAL for each in own)
    if len(given) > len(placed) and not takes_any:
        few = plural(len(placed) or "no", "value")
        bare = " without a name" if len(named) > len(placed) else ""
        return f"{title} takes {few}{bare}, and is given {len(given)}."
    if twice := [name for name in placed[: len(given)] if name in kwargs]:
        return f"{title} is given {twice[0]} twice."
    here = {*placed[: len(given)], *kwargs}
    missing = [n for n, each in named.items() if n not in here and each.default is each.empty]
    return f"{title} needs {' and '.join(missing)}."


def _unknown(title: str, name: str, names: Sequence[str]) -> str:
    if "rate_per_hour" in names and name in _PER_MINUTE:
        return f"There is no argument {name!r}: give rate_per_hour=per_minute(...)."
    if names:
        try:
            one_of("argument", name, names, is_exact=True)
        except UnknownNameError as unknown:
            return str(unknown)
    return f"{title} takes no arguments with a name."
