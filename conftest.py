"""What pytest collects, and what nbval compares."""

from typing import Any

import pytest
from nbval.plugin import IPyNbCell, IPyNbFile  # type: ignore[import-untyped]

collect_ignore = ["tests/data"]


def pytest_collectstart(collector: pytest.Collector) -> None:
    """Leave out LaTeX: SymPy's wording changes, and the plain text beside it is compared."""
    if isinstance(collector, IPyNbFile):
        collector.skip_compare += ("text/latex",)


def pytest_itemcollected(item: pytest.Item) -> None:
    """Leave out the HTML of a picture: a stored notebook holds the PNG alone."""
    if isinstance(item, IPyNbCell):
        compare = item.compare_outputs
        item.compare_outputs = lambda outputs, *rest, **named: compare(
            [without_second_picture(output) for output in outputs], *rest, **named
        )


def without_second_picture(output: Any) -> Any:
    """Return an output without the HTML that holds the PNG beside it."""
    data = output.get("data", {})
    if "image/png" not in data or "text/html" not in data:
        return output
    return type(output)(output, data={kind: data[kind] for kind in data if kind != "text/html"})
