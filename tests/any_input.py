"""Whatever is given to a public name: the calls of the docstrings, with odd values put into them.

The examples of the docstrings are run, and what they call is noted with its arguments. So there is
no list of names to keep: a public name with an example is tried, and each has one.
"""

import contextlib
import datetime
import decimal
import doctest
import fractions
import importlib
import inspect
import io
import math
import pkgutil
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import numpy as np
import sympy

import cammotion as cm
from cammotion.arguments import calls, kinds

WRAPPERS = {calls.__file__, kinds.__file__, contextlib.__file__}

ODD: list[Any] = [
    *(None, True, False, 0, 1, -1, 2, 3.5, 8.0, 360, 361, -5, 1e-300, 1e300, -1e300, 10**400),
    *(math.nan, math.inf, -math.inf, 1j, decimal.Decimal("2.5"), fractions.Fraction(5, 2)),
    *(np.int64(8), np.float32(2.5), np.bool_(True), np.float64("nan"), np.datetime64("2020-01-01")),
    *("", "0.5", "170", "4,154", "die", "cycloid", "Cycloidal", "no", "\0", "a" * 10000, "=1+1"),
    *(b"die", (), [], {}, set(), [1, 2], (1, 2, 3), [[1], [2, 3]], ["die"], {"die": 1}, {1.0}),
    *([None], ["a", 1], [math.nan], [0.5, 0.5], [decimal.Decimal("0.5")], (0.2, 0.1)),
    *(np.array([]), np.zeros((2, 2)), np.array([1, "a"], dtype=object), np.array(["a", "b"])),
    *(np.ma.masked_array([1.0, 2.0], [False, True]), np.ma.masked, np.array([0.5, None])),
    *(sympy.Symbol("q"), cm.x, sympy.Integer(3), sympy.nan, sympy.zoo, sympy.I, sympy.pi, cm.x**2),
    *(cm.LAWS["cycloidal"], cm.EXAMPLE.die, cm.EXAMPLE.diagram, cm.rise(50, over_deg=55)),
    *(Path("nowhere/at/all.csv"), Path("\0"), int, object(), print, len, lambda x: x),
    *(range(3), iter([1.0, 2.0]), (n for n in range(2)), datetime.timedelta(seconds=1)),
    *(cm.EXAMPLE.die.segments[0], slice(None), NotImplemented, Ellipsis, cm, cm.InputError),
]


@dataclass(frozen=True, eq=False)
class Recorded:
    """A call that a docstring makes, and what came of it, if it came to an end."""

    name: str
    function: Callable[..., Any]
    arguments: dict[str, Any]
    made: list[Any]

    def with_values(self, given: Mapping[str, Any]) -> Any:
        """Make the call with some arguments exchanged by others of their kind."""
        bound = inspect.signature(self.function).bind_partial()
        bound.arguments.update({**self.arguments, **given})
        return self.function(*bound.args, **bound.kwargs)

    def with_value(self, parameter: str, value: Any) -> Any:
        """Make the call with one argument exchanged, by anything."""
        bound = inspect.signature(self.function).bind_partial()
        bound.arguments.update({**self.arguments, parameter: value})
        kind = bound.signature.parameters[parameter].kind
        if kind is inspect.Parameter.VAR_POSITIONAL:
            bound.arguments[parameter] = (value,)
        elif kind is inspect.Parameter.VAR_KEYWORD:
            bound.arguments[parameter] = {"odd": value}
        return self.function(*bound.args, **bound.kwargs)


def public() -> dict[CodeType, tuple[str, Callable[..., Any]]]:
    """Return everything public that can be called, by its code: functions, classes, methods."""
    found = {}
    for name in cm.__all__:
        thing = getattr(cm, name)
        for label, function in callables(name, thing):
            if code := getattr(inspect.unwrap(function), "__code__", None):
                found[code] = (label, function)
    return found


def callables(name: str, thing: Any) -> Iterator[tuple[str, Callable[..., Any]]]:
    """Yield a function, or what can be called of a class or an object."""
    if inspect.isfunction(thing):
        yield name, thing
        return
    kind = thing if inspect.isclass(thing) else type(thing)
    if not kind.__module__.startswith("cammotion"):
        return
    for method, function in inspect.getmembers_static(kind, inspect.isfunction):
        is_list = hasattr(kind, "__len__") and not issubclass(kind, Mapping)
        is_index = method == "__getitem__" and is_list  # Python's to refuse
        is_own = not is_index and function.__module__.startswith("cammotion")
        if is_own and (
            not method.startswith("_") or method in {"__init__", "__call__", "__getitem__"}
        ):
            yield f"{kind.__name__}.{method}", function


def recorded() -> list[Recorded]:
    """Run the examples of all docstrings, and return what public names they call, and with what."""
    known, calls = public(), []
    under_way: dict[FrameType, Recorded] = {}

    def called(frame: FrameType, _event: str, _: Any) -> Callable[..., Any] | None:
        if frame.f_code not in known or not is_example(caller(frame)):
            return None  # nothing within it is told, which would take a minute
        label, function = known[frame.f_code]
        given = {name: frame.f_locals[name] for name in inspect.signature(function).parameters}
        if function.__name__ == "__init__":  # a new object each time, not one that is changed
            label, function = label.removesuffix(".__init__"), type(given.pop("self"))
        calls.append(Recorded(label, function, given, []))
        under_way[frame] = calls[-1]
        frame.f_trace_lines = False
        return ended

    def ended(frame: FrameType, event: str, result: Any) -> None:
        if event == "return" and (call := under_way.pop(frame, None)):
            call.made.append(frame.f_locals["self"] if isinstance(call.function, type) else result)

    finder, runner = doctest.DocTestFinder(), doctest.DocTestRunner(verbose=False)
    for module in pkgutil.walk_packages(cm.__path__, "cammotion."):
        if module.name.endswith("__main__"):
            continue
        for test in finder.find(importlib.import_module(module.name)):
            sys.settrace(called)
            try:
                with contextlib.redirect_stdout(io.StringIO()):
                    runner.run(test)
            finally:
                sys.settrace(None)
    return calls


def caller(frame: FrameType) -> FrameType | None:
    """Return who has called, what is put around a function left out."""
    back = frame.f_back
    while back and back.f_code.co_filename in WRAPPERS:
        back = back.f_back
    return back


def is_example(frame: FrameType | None) -> bool:
    return frame is not None and frame.f_code.co_filename.startswith("<doctest")
