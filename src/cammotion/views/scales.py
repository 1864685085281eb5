"""Scales for pictures and numbers for readouts, also where a peak is infinite."""

import math

from matplotlib.ticker import LogLocator

from cammotion.quantities import as_text

_THOUSAND = 1000
_ROUNDING = 1e-9  # of the ends of a range: it is none where it is no wider
_NOTHING = 5e-11  # of the largest number on a scale
_ONE_TWO_FIVE = LogLocator(subs=(1, 2, 5))


def round_down(value: float) -> float:
    """Return the largest of ... 1, 2, 5, 10, 20 ... that is not above a value, itself above 0.

    >>> round_down(4.154), round_down(20.0)
    (2.0, 20.0)
    """
    ticks = _ONE_TWO_FIVE.tick_values(value / 10, value)
    return float(max(tick for tick in ticks if tick <= value))


def trimmed(value: float, digits: int) -> str:
    """Return a number with so many decimals at most: no zeros stand at its end.

    >>> trimmed(2.5, 3), trimmed(40, 2)
    ('2.5', '40')
    """
    return f"{value:.{digits}f}".rstrip("0").rstrip(".")


def short_number(value: float, more: int = 0, size: float = 1.0) -> str:
    """Return a number for a scale, with so many `more` digits than the three that are usual.

    `size` is the largest on the scale: beside it what is left of rounding is 0.

    >>> short_number(0.1111), short_number(-1000.4), short_number(94_923), short_number(-1e-12)
    ('0.111', '−1000', '94920', '0')
    >>> short_number(-1e-12, size=2e-12)
    '−1e−12'
    """
    value = 0.0 if abs(value) <= _NOTHING * size else value
    digits = more + (3 if abs(value) < _THOUSAND else 4)
    return as_text(value, f".{digits}g").replace("-", "−")


def more_digits(low: float, high: float) -> int:
    """Return how many more digits than three tell the ends of a range apart, as three do from 0 on.

    >>> more_digits(0, 50), more_digits(1000, 1050), more_digits(1000, 1000)
    (0, 1, 0)
    """
    wide = high - low
    if wide <= _ROUNDING * max(abs(low), abs(high)):
        return 0
    return max(0, math.floor(math.log10(max(abs(low), abs(high)) / wide)))


def from_to(low: float, high: float, more: int = 0) -> str:
    """Return the ends of a range for a scale, with as many digits as it takes to tell them apart.

    >>> from_to(-50, 50), from_to(12345, 12350)
    ('−50 to 50', '12345 to 12350')
    >>> from_to(5.26, 5.26), from_to(-1.83e-12, 1.83e-12)
    ('5.26', '−1.83e−12 to 1.83e−12')
    """
    size = max(abs(low), abs(high))
    if low == high:
        return short_number(low, more, size)
    more = max(more, more_digits(low, high))
    return f"{short_number(low, more, size)} to {short_number(high, more, size)}"
