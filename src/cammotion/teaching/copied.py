"""Numbers of the lesson's machine in the place of a learner's own: the usual slip of a copy."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import fields, is_dataclass, replace
from functools import lru_cache
from typing import Any

from cammotion.laws.catalogue import LAWS
from cammotion.quantities import InputError
from cammotion.teaching.example import EXAMPLE, MillAndDie

_TOGETHER = (("wait_mm", "pocket_mm", "gap_mm"), ("mill_angle_deg", "work_deg"))
"""What one number of a lesson stands for: the stroke, the angle of the die without overlap."""


@lru_cache(maxsize=2**8)
def with_lessons_numbers(machine: MillAndDie) -> tuple[MillAndDie, ...]:
    """Return machines with one of their numbers as the lesson's machine has it.

    >>> from cammotion.teaching.variants import machine_for
    >>> anna = machine_for("Anna")
    >>> any(one == replace(anna, work_deg=100) for one in with_lessons_numbers(anna))
    True
    """
    groups = [{name: getattr(EXAMPLE, name) for name in names} for names in _TOGETHER]
    return (*_with_one_of(machine, EXAMPLE), *(replace(machine, **group) for group in groups))


def with_one_of_the_lesson(
    of: Callable[..., float], own: Sequence[float], lessons: Sequence[float]
) -> Iterator[float]:
    """Yield what follows from numbers if one is the lesson's, in full or to three digits.

    >>> [*with_one_of_the_lesson(lambda way, time: way / time, (6, 3), (8, 2.0004))]
    [2.6666666666666665, 2.6666666666666665, 2.9994001199760048, 3.0]
    """
    for place, number in enumerate(lessons):
        for typed in (number, float(f"{number:.3g}")):
            with suppress(InputError):  # with these numbers there is no such machine
                yield of(*own[:place], typed, *own[place + 1 :])


def _with_one_of(own: Any, others: Any) -> Iterator[Any]:
    """Yield a value, a tuple or a record with one number of it as another of its kind has it."""
    if is_dataclass(own):
        for name in (field.name for field in fields(own) if field.compare):
            for one in _with_one_of(getattr(own, name), getattr(others, name)):
                yield replace(own, **{name: one})  # type: ignore[type-var]
    elif isinstance(own, tuple) and len(own) == len(others):
        for place in range(len(own)):
            for one in _with_one_of(own[place], others[place]):
                parts = [*own[:place], one, *own[place + 1 :]]
                yield type(own)(*parts) if hasattr(own, "_fields") else tuple(parts)
    elif own != others and not _is_no_number(others):
        yield others


def _is_no_number(one: Any) -> bool:
    """Tell what nobody copies as a number: 0, of what the lesson does not have, and a law's name.

    Who forgets a hole has not copied one of 0 mm, and another law has a reason of its own.
    """
    return one in LAWS if isinstance(one, str) else one == 0
