"""What each number that is asked for is called, its unit, its example and its range.

All of it is said to who gives a number out of range, so that no change of it is an accident: run
this file to write the table anew, and read what has changed.
"""

import importlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from test_house import MODULES

from cammotion.quantities import InputError, Quantity

KEPT = Path(__file__).parent / "data" / "quantities.txt"


def found() -> dict[str, Quantity]:
    """Return the quantities of all modules, by where they stand."""
    return {
        f"{module}.{name}": item
        for module in sorted(MODULES)
        for name, item in vars(importlib.import_module(f"cammotion.{module}")).items()
        if isinstance(item, Quantity)
    }


def table() -> Iterator[str]:
    """Yield a line for each quantity, once where several modules have it."""
    seen: set[int] = set()
    for place, one in found().items():
        if id(one) not in seen:
            seen.add(id(one))
            low = "[" if one.low_included else "("
            yield (
                f"{place}: {one.name}, {one.example:.10g} {one.unit} in {low}{one.low:.10g}, "
                f"{one.high:.10g}], {one.kind}, {one.rounding:g}"
            )


@pytest.mark.parametrize(("place", "one"), found().items())
def test_an_example_is_one(place: str, one: Quantity) -> None:
    assert one.number(one.example) == one.example, place
    assert np.array_equal(one.array([one.example]), [one.example])


def test_what_is_asked_for_is_as_it_is_kept() -> None:
    assert [*table()] == KEPT.read_text("utf-8").splitlines()


@pytest.mark.parametrize("beyond", [1e60, 1e-60])
def test_a_number_whose_powers_overflow_is_told_how_large_it_may_be(beyond: float) -> None:
    with pytest.raises(InputError, match=r"a number of 1e-50 to 1e\+50 above 0 mm: give"):
        Quantity("stroke", "mm", example=50).number(beyond)


if __name__ == "__main__":
    KEPT.write_text("\n".join(table()) + "\n", "utf-8", newline="")
