"""Numbers of the lesson's machine in the place of a learner's own: the usual slip of a copy."""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from functools import lru_cache
from typing import Any

from cammotion.teaching.example import EXAMPLE, MillAndDie

_TOGETHER = (("wait_mm", "pocket_mm", "gap_mm"), ("mill_angle_deg", "work_deg"))
"""What one number of a lesson stands for: the stroke, the angle of the die without overlap."""


@lru_cache(maxsize=2**8)
def mixed(machine: MillAndDie) -> tuple[MillAndDie, ...]:
    """Return machines with one number of the lesson's, and the lesson's with one of theirs.

    >>> from cammotion.teaching.variants import machine_for
    >>> anna = machine_for("Anna")
    >>> any(one == replace(anna, work_deg=100) for one in mixed(anna))
    True
    >>> any(one == replace(EXAMPLE, die_mass_kg=anna.die_mass_kg) for one in mixed(anna))
    True
    """
    return (*_with_one_of(machine, EXAMPLE), *_with_one_of(EXAMPLE, machine))


def _with_one_of(machine: MillAndDie, other: MillAndDie) -> Iterator[MillAndDie]:
    yield from _with_one_field_of(machine, other)
    for names in _TOGETHER:
        yield replace(machine, **{name: getattr(other, name) for name in names})


def _with_one_field_of(record: Any, other: Any) -> Iterator[Any]:
    """Yield a record with one field as another has it, also in the records that it holds."""
    for field in fields(record):
        own, others = getattr(record, field.name), getattr(other, field.name)
        if is_dataclass(own):
            for inner in _with_one_field_of(own, others):
                yield replace(record, **{field.name: inner})
        elif field.compare and own != others:
            yield replace(record, **{field.name: others})
