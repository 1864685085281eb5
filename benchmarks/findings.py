"""What a measure finds, and how it is judged."""

import statistics
import sys
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Finding:
    """A measured value and its limit: the most it may be, or with `at_least` the least."""

    what: str
    value: float
    limit: float
    unit: str
    at_least: bool = False

    @property
    def ok(self) -> bool:
        """Whether the value keeps the limit."""
        return self.value >= self.limit if self.at_least else self.value <= self.limit


def say(text: str) -> None:
    """Show how far a measure is, beside the table and not in it."""
    print(f"  ... {text}", file=sys.stderr, flush=True)


def percentile_95(values: Sequence[float]) -> float:
    """Return the value that one in twenty exceeds."""
    return statistics.quantiles(values, n=20, method="inclusive")[-1]


def ratio_of_medians(values: Sequence[float], others: Sequence[float]) -> float:
    """Return how many times larger `values` are than `others`."""
    return statistics.median(values) / statistics.median(others)
