"""Whatever is given to a public name: the calls of the docstrings, with odd values put into them.

The examples of the docstrings are run, and what they call is noted with its arguments. So there is
no list of names to keep: a public name with an example is tried, and each has one.
"""

import ast
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
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import CodeType
from typing import Any

import numpy as np
import sympy
from desk import restart
from matplotlib import pyplot as plt

import cammotion as cm

NOTE = "__note__"

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


def run_examples() -> tuple[list[Recorded], str]:
    """Run the examples of all docstrings; return their calls of public names, and what failed.

    Each begins as a kernel does. In what failed each call is shown as one of `__note__`.
    """
    known, calls, failed = public(), [], io.StringIO()

    def note(function: Callable[..., Any], *args: Any, **named: Any) -> Any:
        """Make a call of an example; if it is one of a public name, keep it."""
        code, given = called(function, args)
        if code not in known:
            return function(*args, **named)
        label, plain = known[code]
        bound = inspect.signature(plain).bind(*given, **named)
        bound.apply_defaults()
        if plain.__name__ == "__init__":  # a new object each time, not one that is changed
            label, plain = label.removesuffix(".__init__"), function
            del bound.arguments["self"]
        calls.append(Recorded(label, plain, {**bound.arguments}, []))
        made, result = calls[-1].made, function(*args, **named)
        made.append(result)
        return result

    finder = doctest.DocTestFinder()
    runner = doctest.DocTestRunner(verbose=False, optionflags=doctest.ELLIPSIS)
    for module in pkgutil.walk_packages(cm.__path__, "cammotion."):
        if module.name.endswith("__main__"):
            continue
        for test in finder.find(importlib.import_module(module.name)):
            if not test.examples:  # to run none of them takes time too
                continue
            for example in test.examples:
                example.source = noted(example.source)
            test.globs[NOTE] = note
            restart()
            with contextlib.redirect_stdout(io.StringIO()):
                runner.run(test, out=failed.write)
            plt.close("all")
    return calls, failed.getvalue()


def called(function: Callable[..., Any], args: Sequence[Any]) -> tuple[CodeType | None, list[Any]]:
    """Return the code that a call comes to, and what is given to it by place, `self` included."""
    given = [*args]
    if inspect.isclass(function):
        function, given = function.__init__, [None, *args]
    elif not inspect.isroutine(function):
        function, given = type(function).__call__, [function, *args]  # an object that is called
    if inspect.ismethod(function):
        given, function = [function.__self__, *args], function.__func__
    return getattr(inspect.unwrap(function), "__code__", None), given


def noted(source: str) -> str:
    """Return an example in which each call, and each index, is made by `note`."""
    tree = Noting().visit(ast.parse(source, mode="single"))
    return f"{ast.unparse(ast.fix_missing_locations(tree))}\n"


class Noting(ast.NodeTransformer):
    """It puts `note` before all that is called."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Let it be made by `note`."""
        self.generic_visit(node)
        return ast.Call(ast.Name(NOTE, ast.Load()), [node.func, *node.args], node.keywords)

    def visit_Subscript(self, node: ast.Subscript) -> ast.AST:
        """Let what is read at an index be a call; a slice is none."""
        self.generic_visit(node)
        if not isinstance(node.ctx, ast.Load) or isinstance(node.slice, ast.Slice):
            return node
        method = ast.Attribute(node.value, "__getitem__", ast.Load())
        return ast.Call(ast.Name(NOTE, ast.Load()), [method, node.slice], [])
