"""What a quantity may be, and the sentence that says so when it is not."""

import math
import numbers
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from decimal import Decimal
from difflib import get_close_matches
from linecache import getline
from traceback import walk_tb
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cammotion.typed import typed_numbers

_TINY = 1e-50  # no divisor is smaller, and no number larger than 1/that: their powers overflow
_PLAIN = 1e5  # a number below it is read without a power of ten
_OUTWARD = 4  # decimals
_MOST_DECIMALS = 7  # what needs more is written with a power of ten
_SMALL = 0.1  # of a number below it fewer digits are left than there are decimals
_MANY = 100  # pieces/h, from which whole ones are told
_LONG, _LISTED = 60, 600  # of a name that is compared with others; of a list of names
_NEAR, _WORD = 3, 3  # names that are said at most; letters of a part that says something
_NONE: Mapping[str, str] = {}

Floats = NDArray[np.float64]

Numbers: TypeAlias = Any
"""A float where every argument is a single number, else an array (as NumPy types its functions)."""


class InputError(ValueError):
    """A value that makes no sense here; the message names it, what is allowed, and the fix."""

    __module__ = "cammotion"  # the name under which its reader can catch it

    def _render_traceback_(self) -> list[str]:
        """Return what a notebook shows: the reader's own lines and the sentence."""
        own = [
            f"line {line}: {getline(frame.f_code.co_filename, line).strip()}"
            for frame, line in walk_tb(self.__traceback__)
            if frame.f_globals.get("__name__") == "__main__"
        ]
        return [*own, f"{InputError.__name__}: {self}"]


class UnknownNameError(InputError, KeyError):
    """A name that is not known; of a mapping it is a KeyError, as usual."""

    __str__ = Exception.__str__  # a KeyError shows its sentence in quotes


class WrongAnswerError(RuntimeError):
    """A solver has found by its own check that its answer is wrong; no number is given out."""

    __module__ = "cammotion"

    def __init__(self, solver: str, found: str) -> None:
        super().__init__(
            f"{solver} has checked its answer and found it wrong: {found}. This is a fault of the "
            "workbook and not yours: please report it, with the machine that you asked about."
        )


@dataclass(frozen=True)
class Quantity:
    """A physical quantity with its unit and the range in which it makes sense.

    `low` itself is allowed only where `low_included` is set; `high` always is. What misses an
    end by no more than `rounding` is there. `kind` says in words what is asked for, and `instead`
    what else may be given.

    >>> Quantity("indexing angle", "deg", example=55, high=360).array([27.5, 55])
    array([27.5, 55. ])
    """

    name: str
    unit: str
    example: float
    low: float = 0.0
    high: float = math.inf
    low_included: bool = False
    kind: str = "finite number"
    rounding: float = 0.0
    instead: str = ""

    def array(self, value: ArrayLike) -> Floats:
        """Return `value` as an array of floats of the same shape, each of them in range.

        Raises InputError for anything that is not a real number, is not finite, is out of range,
        or is empty.
        """
        array = self._as_floats(value)
        if array.size == 0:
            raise InputError(f"The {self.name} is empty: give {self._example}.")
        if self._spans(array.min(), array.max()):  # many at once take no detour
            return array
        inside = self._inside(array)
        if inside.all():
            return array
        if self.rounding:
            near = np.clip(array, self.low, self.high)
            if np.all(np.abs(array - near) <= self.rounding):
                return near
        raise InputError(self._out_of_range(array, inside))

    def rising(self, value: ArrayLike) -> tuple[Floats, bool]:
        """Return what `array` does, and whether no number of it is less than the one before.

        Of those only the ends have to be looked at.
        """
        array = self._as_floats(value)
        rises = is_rising(array)
        is_known = rises and self._spans(array.flat[0], array.flat[-1])
        return (array if is_known else self.array(array)), rises

    def number(self, value: Any) -> float:
        """Return `value`, a single number, as a float; raises InputError like `array`."""
        if type(value) is float and self._inside(value):
            return value  # the usual one takes no detour
        array = self.array(value)
        if array.ndim:
            raise InputError(
                f"The {self.name} has to be a single number here, not {shorten(value)}: "
                f"give {self._example}."
            )
        return float(array)

    def whole(self, value: Any) -> int:
        """Return `value`, a single whole number such as 8 or 8.0, as an int.

        Raises InputError like `number`, and for a number that is not whole.

        >>> Quantity("number of stops", "", example=8).whole(24.0)
        24
        """
        if type(value) is int and self.low < value <= min(self.high, 1 / _TINY):
            return value  # the usual one takes no detour
        quantity = replace(self, kind="whole number")
        number = quantity.number(value)
        if number != int(number):
            raise InputError(quantity._refusal(number))
        return int(number)

    @property
    def allowed(self) -> str:
        """The range in words, after 'a finite number': ' above 0 and at most 360 deg'.

        >>> Quantity("stroke", "mm", example=50).allowed
        ' above 0 mm'
        """
        if math.isinf(self.low):
            return ""
        low = f"{'at least' if self.low_included else 'above'} {self.low:g}"
        high = "" if math.isinf(self.high) else f" and at most {self.high:g}"
        return f" {low}{high}{self._unit}"

    @property
    def _least(self) -> float:
        return self.low or _TINY  # what has to be above 0 is not as good as 0

    @property
    def _unit(self) -> str:
        return f" {self.unit}" if self.unit else ""

    @property
    def _example(self) -> str:
        other = f"{self.instead}, or " if self.instead else ""
        return f"{other}for example {self.example:g}{self._unit}"

    def _as_floats(self, value: ArrayLike) -> Floats:
        if is_masked(value):
            raise InputError(
                f"The {self.name} has masked values, which are none: leave them out, for example "
                "with .compressed()."
            )
        try:
            array = np.asarray(value)
        except (ValueError, TypeError):  # a ragged list, or what only seems to be one
            array = np.asarray(None)
        if array.dtype.kind in "iuf":
            return array.astype(np.float64, copy=False)
        if array.size == 0:
            return np.empty(0)
        if array.dtype.kind == "O" and all(is_real(item) for item in array.flat):
            return np.array([_as_float(item) for item in array.flat]).reshape(array.shape)
        typed = typed_numbers(value)
        sensible = [each for each in typed if self._inside(np.array(float(each)))] or typed
        meant = (
            f"it as a number, {' or '.join(sensible)} without quotes" if typed else self._example
        )
        raise InputError(
            f"The {self.name} has to be a number{' in ' + self.unit if self.unit else ''}, "
            f"not {shorten(value)}: give {meant}."
        )

    def _inside(self, value: Any) -> Any:
        """Return whether a float is in the range, or of an array which of its numbers are."""
        above = value >= self.low if self.low_included else value > self._least
        return above & (value <= self.high) & (abs(value) <= 1 / _TINY)

    def _spans(self, least: float, most: float) -> bool:
        """Tell whether the least and the most of some numbers are in the range; nan is in none."""
        is_above = least > self._least or (self.low_included and least == self.low)
        return bool(is_above and most <= self.high < math.inf)

    def _out_of_range(self, array: Floats, inside: NDArray[np.bool_]) -> str:
        position = tuple(int(i) for i in np.argwhere(~inside)[0])
        where = f" (at position {', '.join(map(str, position))})" if position else ""
        return self._refusal(array[position], where)

    def _refusal(self, number: float, where: str = "") -> str:
        kind = self.kind if _is_usual(number) else f"number of {_TINY:g} to {1 / _TINY:g}"
        return (
            f"The {self.name} is {self._told(number)}{self._unit}{where}; it has to be a "
            f"{kind}{self.allowed}: give {self._example}."
        )

    def _told(self, number: float) -> str:
        """Return a number that is refused, with as many digits as show why."""
        short = f"{number:g}"
        is_hidden = short in (f"{self.low:g}", f"{self.high:g}") or self._inside(float(short))
        return repr(float(number)) if is_hidden and number not in (self.low, self.high) else short


def keep_numbers(owner: object, **readers: Callable[[Any], float]) -> None:
    """Let fields of a frozen dataclass be the numbers that they are read as.

    So what is computed from them need not know of `Decimal`, `Fraction` or NumPy. A reader is
    `number` or `whole` of a Quantity; raises InputError like these.
    """
    for field, read in readers.items():
        object.__setattr__(owner, field, read(getattr(owner, field)))


def one_of(
    what: str,
    name: Any,
    known: Iterable[str],
    also: Mapping[str, str] = _NONE,
    *,
    is_exact: bool = False,
) -> str:
    """Return the one of the `known` names that `name` is; `also` has other names of them.

    Unless `is_exact` it may be in any case, where that is one of them alone. Otherwise raise
    InputError with those that are near, or with all.

    >>> one_of("motion law", "Cycloidal", ["cycloidal", "cubic"])
    'cycloidal'
    """
    names = {known_name: known_name for known_name in known}
    if isinstance(name, str) and name not in names:
        given, folded = name[:_LONG].casefold(), _folded({**also, **names})
        if not is_exact and len(folded.get(given, ())) == 1:
            return folded[given][0]
        if near := _near(given, folded):
            raise UnknownNameError(f"There is no {what} {shorten(name)}: did you mean {near}?")
    return to_the_letter(what, name, names)


def to_the_letter(what: str, name: Any, known: Iterable[str]) -> str:
    """Return a name that is one of the `known` as it stands, since those near mean other things.

    Otherwise raise InputError with all.

    >>> to_the_letter("letter of a shaft", "g", ["f", "g"])
    'g'
    """
    names = [*known]
    if isinstance(name, str) and name in names:
        return name
    listed = shorten(", ".join(f"'{each}'" for each in names), _LISTED, of=str)
    raise UnknownNameError(f"There is no {what} {shorten(name)}: use one of {listed}.")


def _folded(names: Mapping[str, str]) -> dict[str, list[str]]:
    """Return by each name, without its case, the names that it may stand for."""
    folded: dict[str, list[str]] = {}
    for other, one in names.items():
        meant = folded.setdefault(str(other).casefold(), [])
        if str(one) not in meant:
            meant.append(str(one))
    return folded


def _near(given: str, folded: Mapping[str, list[str]]) -> str:
    """Return in words the names that may be meant, an empty text for none."""
    ones = dict.fromkeys(one for meant in folded.values() for one in meant)
    said = _bare(given)
    holding = [one for one in ones if len(said) >= _WORD and said in _bare(one.casefold())]
    close = [one for each in get_close_matches(given, folded) for one in folded[each]]
    meant = dict.fromkeys(f"'{one}'" for one in [*holding, *close])
    return " or ".join([*meant][:_NEAR])


def _bare(name: str) -> str:
    """Return the letters and digits of a name: 345 stands in "3-4-5 polynomial"."""
    return "".join(filter(str.isalnum, name))


def broadcast(**arrays: Floats) -> None:
    """Raise InputError unless the arrays can be combined element by element."""
    try:
        np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name} has {array.shape}" for name, array in arrays.items())
        raise InputError(
            f"The arrays cannot be combined element by element, their shapes differ ({shapes}): "
            "give single numbers or arrays of one shape."
        ) from None


def shorten(value: object, length: int = 60, *, of: Callable[[object], str] = repr) -> str:
    """Return a value as a sentence can show it, however long it is."""
    text = of(value)
    return text if len(text) <= length else text[: length - 3] + "..."


def as_text(value: float, digits: str) -> str:
    """Return a number in so many `digits`, a format of Python's, and an infinite one as a sign.

    >>> as_text(4.154, ".3g"), as_text(41542, ".3g"), as_text(415.4, "#.3g")
    ('4.15', '41500', '415')
    >>> as_text(math.inf, ".3g"), as_text(-math.inf, ".3g")
    ('∞', '-∞')
    """
    if math.isinf(value):
        return "∞" if value > 0 else "-∞"
    text = format(value, digits)
    if "e+" in text and abs(value) < _PLAIN:
        text = f"{float(text):.0f}"
    return text.removesuffix(".")


def in_decimals(value: float, decimals: int) -> str:
    """Return a number with so many decimals; one that is too small for them with as many digits.

    >>> in_decimals(4.1544, 3), in_decimals(0.03712, 3), in_decimals(0.0, 3), in_decimals(1e9, 3)
    ('4.154', '0.0371', '0.000', '1000000000.000')
    """
    is_small = 0 < abs(value) < _SMALL
    return as_text(value, f"#.{decimals}g" if is_small else f".{decimals}f")


def rate_as_text(rate_per_hour: float) -> str:
    """Return a machine rate in whole pieces/h, and one below 100 with three digits.

    >>> rate_as_text(3856.8), rate_as_text(4.816), rate_as_text(math.inf)
    ('3857', '4.82', '∞')
    """
    return as_text(rate_per_hour, ".0f" if rate_per_hour >= _MANY else ".3g")


def decimals_of(value: float, fewest: int) -> int:
    """Return how many decimals show a number: so many, or more for as many digits of a small one.

    >>> decimals_of(38.5, 3), decimals_of(0.00046, 3)
    (3, 6)
    """
    return max(fewest, fewest - 1 - math.floor(math.log10(value))) if 0 < value < 1 else fewest


def outward(low: float, high: float) -> tuple[str, str]:
    """Return two values from 0 on as texts, rounded away from what is between them.

    >>> outward(0.51949, 0.51951), outward(0.00046753, 0.00046755), outward(5.3881e-8, 5.9006e-8)
    (('0.5194', '0.5196'), ('0.0004675', '0.0004676'), ('5.388e-08', '5.901e-08'))
    """
    decimals = decimals_of(high, _OUTWARD)
    parts = 10.0**decimals
    ends = np.floor(low * parts) / parts, np.ceil(high * parts) / parts
    if decimals > _MOST_DECIMALS:
        return f"{ends[0]:.{_OUTWARD - 1}e}" if ends[0] else "0", f"{ends[1]:.{_OUTWARD - 1}e}"
    return f"{ends[0]:.{decimals}f}", f"{ends[1]:.{decimals}f}"


def plural(number: int | str, what: str) -> str:
    """Return a number of things; "no" is a number, too.

    >>> plural(1, "rule"), plural(2, "rule"), plural("no", "rule")
    ('1 rule', '2 rules', 'no rules')
    """
    return f"{number} {what}{'' if number == 1 else 's'}"


def _is_usual(number: float) -> bool:
    return not math.isfinite(number) or number == 0 or _TINY <= abs(number) <= 1 / _TINY


def is_real(item: object) -> bool:
    """Whether something is one real number, of Python, NumPy or a library; True is none."""
    is_number = isinstance(item, numbers.Real | Decimal)
    return is_number and not isinstance(item, (bool, np.bool_))


def _as_float(item: Any) -> float:
    try:
        return float(item)
    except OverflowError:  # 10**400, which no float can hold
        return math.inf if item > 0 else -math.inf
    except ValueError:  # the signalling nan of Decimal
        return math.nan


def is_masked(value: object) -> bool:
    """Whether a value is masked, or one in an array, a list or a tuple is."""
    items = value if isinstance(value, list | tuple) else ()
    return bool(np.ma.is_masked(value)) or any(item is np.ma.masked for item in items)


def listed(values: Any) -> tuple[Any, ...]:
    """Return what can be gone through as a tuple; an empty one for a text, and for anything else.

    >>> listed(range(2)), listed("die"), listed(None)
    ((0, 1), (), ())
    """
    try:
        return () if isinstance(values, str | bytes) else tuple(values)
    except TypeError:
        return ()


def is_rising(values: Floats) -> bool:
    """Tell whether no number is less than the one before; nan is in no order.

    >>> is_rising(np.array([0.0, 1.0, 1.0])), is_rising(np.array([1.0, 0.0]))
    (True, False)
    """
    row = np.ravel(values)
    return bool(row.size and (row[1:] >= row[:-1]).all())


def plain(values: Numbers) -> Numbers:
    """Return a float for a single number, the array for an array.

    >>> plain(np.array(2.5)), plain(np.array([1.0, 2.0]))
    (2.5, array([1., 2.]))
    """
    return values if np.ndim(values) else float(values)
