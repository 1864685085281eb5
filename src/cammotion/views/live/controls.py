"""The controls of a live figure, completed by the notation."""

import math
from dataclasses import replace
from typing import Any

import sympy as sp

from cammotion.quantities import InputError, is_masked, shorten
from cammotion.views.live.parts import Choice, Control
from cammotion.views.notation import meaning
from cammotion.views.scales import round_down

MOST_CONTROLS = 12
_MOST = 1e100  # beyond it a width or a square is infinite


def complete(symbol: sp.Symbol, control: Control) -> Control:
    """Return a control with a start, a step, a name and a unit; raise InputError for a bad one."""
    known = meaning(symbol.name)
    name = known.name if control.name is None else control.name
    unit = known.unit if control.unit is None else control.unit
    low, high = (_bound(name, end) for end in (control.low, control.high))
    if not low < high:
        raise InputError(
            f"The control {name} goes from {low:g} to {high:g}: give a range (low, high) with the "
            "lower end first."
        )
    step = _step(high - low) if control.step is None else _bound(name, control.step)
    usual = _start(low, high, step, known.usual)
    start = usual if control.start is None else _bound(name, control.start)
    if not low <= start <= high:
        raise InputError(
            f"The control {name} starts at {start:g}, outside its range from {low:g} to {high:g}: "
            "widen the range or start inside it."
        )
    if not 0 < step <= high - low:
        raise InputError(
            f"The step of the control {name} is {step:g}: give one above 0 that fits into its "
            f"range, at most {high - low:g}."
        )
    return replace(control, low=low, high=high, step=step, start=start, name=name, unit=unit)


def chosen_control(symbol: Choice) -> Control:
    """Return the control of a choice, which is one of its names."""
    count = len(symbol.options)
    return Control(low=0, high=count - 1, step=1, start=symbol.start, name=symbol.name, unit="")


def _bound(name: str, value: Any) -> float:
    try:
        number = math.nan if isinstance(value, str | bool) or is_masked(value) else float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not abs(number) <= _MOST:
        raise InputError(
            f"The control {name} has {shorten(value)} as a number of its range: give numbers "
            f"up to {_MOST:g}, (low, high) or (low, high, step)."
        )
    return number


def _start(low: float, high: float, step: float, usual: float | None) -> float:
    """Return the usual value, or the middle, on a step of the slider."""
    if usual is not None and low <= usual <= high:
        return usual
    return low + math.floor((high - low) / 2 / step) * step if step > 0 else low


def _step(width: float) -> float:
    """Return a round step, of which 150 to 375 make the width."""
    return round_down(width / 150)
