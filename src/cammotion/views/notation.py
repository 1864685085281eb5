"""The notation of the workbook: what a symbol means, its unit, and what it usually is.

A live figure takes from here the names and units of what it is given, and the running variable's
range, where a symbol is known.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

from sympy.printing.pretty.pretty_symbology import greek_unicode


class Meaning(NamedTuple):
    """What a symbol stands for; `usual` is the value of the running example."""

    name: str
    unit: str
    usual: float | None = None

    @property
    def after(self) -> str:
        """What follows a number: a space and the unit, if there is one."""
        return f" {self.unit}" if self.unit else ""


# lengths are in m here, since they stand in formulas for m/s and m/s²
NOTATION = {
    "N": Meaning("machine rate N", "pieces/h", 2000),
    "B_m": Meaning("indexing angle Bm", "deg", 55),
    "h_m": Meaning("stroke hm", "m", 0.05),
    "t_m": Meaning("indexing time tm", "s", 0.275),
    "t": Meaning("time t", "s"),
    "x": Meaning("x = t/tm", ""),
    "alpha": Meaning("cam angle", "deg"),
    "h": Meaning("displacement h", "m"),
    "v": Meaning("velocity v", "m/s"),
    "a": Meaning("acceleration a", "m/s²"),
    "j": Meaning("jerk j", "m/s³"),
}

# what follows from other symbols of the notation: their names, and how
FOLLOWS: dict[str, tuple[tuple[str, ...], Callable[..., Any]]] = {
    "t_m": (("B_m", "N"), lambda angle, rate: 10 * angle / rate)
}
# where a symbol runs from 0 to, a number or the name of another symbol
RUNS_TO: dict[str, int | str] = {"t": "t_m", "x": 1, "alpha": 360}

# metres and seconds to these powers make a quantity that has a symbol
BY_POWERS = {(1, 0): "h", (1, -1): "v", (1, -2): "a", (1, -3): "j"}
METRES = {"h_m": 1, "h": 1}
SECONDS = {"t": 1, "t_m": 1, "N": -1}


def meaning(symbol: str) -> Meaning:
    """Return what a symbol means; an unknown one is its own name, without a unit.

    >>> meaning("B_m")
    Meaning(name='indexing angle Bm', unit='deg', usual=55)
    >>> meaning("omega_1").name
    'ω1'
    """
    letter, *index = symbol.split("_")
    return NOTATION.get(symbol, Meaning("".join([greek_unicode.get(letter, letter), *index]), ""))


def labelled(symbol: str) -> str:
    """Return name and unit of a symbol, as an axis says them.

    >>> labelled("t"), labelled("x")
    ('time t in s', 'x = t/tm')
    """
    known = meaning(symbol)
    return f"{known.name} in {known.unit}" if known.unit else known.name


def axis_label(symbol: str, end: Any) -> str:
    """Return the label of an axis over a symbol: where it does not end as usual, its name alone.

    >>> axis_label("x", 1), axis_label("x", 2.5), axis_label("t", 2.5)
    ('x = t/tm', 'x', 'time t in s')
    """
    usual = RUNS_TO.get(symbol)
    if isinstance(usual, int) and str(end) not in (str(usual), f"{usual}.0"):
        return meaning(f"{symbol}_").name
    return labelled(symbol)
