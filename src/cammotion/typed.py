"""Numbers as they are typed: with a decimal point or comma, or a comma that parts thousands."""

import re

_NUMBER = re.compile(r"[+-]?\d+([.,]\d+)?", re.ASCII)
_TWO = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}", re.ASCII)


def readings(typed: str) -> tuple[str, ...]:
    """Return a typed number with a decimal point, in both ways if it may be two numbers.

    A decimal comma is a point; one comma before three digits may also part thousands.

    >>> readings("4,15"), readings("0,806"), readings("2.400"), readings("-4,154")
    (('4.15',), ('0.806',), ('2.400',), ('-4.154', '-4154'))
    """
    point = typed.replace(",", ".")
    return (point, typed.replace(",", "")) if _TWO.fullmatch(typed) else (point,)


def typed_numbers(value: object) -> tuple[str, ...]:
    """Return the `readings` of a text that is a number, none of anything else.

    >>> typed_numbers("4,15"), typed_numbers(" 55 "), typed_numbers("die"), typed_numbers(None)
    (('4.15',), ('55',), (), ())
    """
    text = value.strip() if isinstance(value, str) else ""
    return readings(text) if _NUMBER.fullmatch(text) else ()
