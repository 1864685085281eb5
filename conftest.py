"""What pytest collects, and what nbval compares."""

import pytest
from nbval.plugin import IPyNbFile  # type: ignore[import-untyped]

collect_ignore = ["tests/data"]


def pytest_collectstart(collector: pytest.Collector) -> None:
    """Leave out LaTeX: SymPy's wording changes, and the plain text beside it is compared."""
    if isinstance(collector, IPyNbFile):
        collector.skip_compare += ("text/latex",)
