"""Arrays of thousands of numbers are compared by NumPy: `pytest.approx` looks at each in Python."""

from typing import Any

import numpy as np


def assert_near(found: Any, expected: Any, *, rel: float = 0, abs: float = 0) -> None:
    """Compare as `pytest.approx` with one of the two bounds; what is no number is near to none."""
    np.testing.assert_allclose(found, expected, rel, abs, equal_nan=False)
