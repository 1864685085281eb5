"""What is given by the names of motions, or of other parts of a machine."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, TypeVar

from cammotion.quantities import InputError, one_of, shorten

T = TypeVar("T")


def by_name(  # noqa: PLR0913 - the last two by their names
    what: str,
    given: Any,
    names: Iterable[str],
    read: Callable[[Any], T],
    example: str,
    *,
    of: str = "motion",
    one_for_all: bool = False,
) -> dict[str, T]:
    """Return what is given for some of the names, each value as `read` returns it; {} for None.

    A name may be in any case. `one_for_all` lets a single value be that of every name. `what` is
    given, in the plural, and `of` what a name names, for the sentence. Raises InputError for what
    is not given by names, for a name that is unknown or there twice, and what `read` raises.

    >>> by_name("weights", {"Die": "12"}, ["mill", "die"], float, "weights={'die': 12}")
    {'die': 12.0}
    >>> by_name("weights", 3, ["mill", "die"], float, "weights=3", one_for_all=True)
    {'mill': 3.0, 'die': 3.0}
    """
    if given is None:
        return {}
    if isinstance(given, Mapping):
        called: dict[str, Any] = {}
        for name in given:
            if (own := one_of(of, name, names)) in called:
                raise InputError(
                    f"The {what} are given twice for the {of} {own!r}, as {shorten(called[own])} "
                    f"and as {shorten(name)}: leave one of them out."
                )
            called[own] = name
        return {own: read(given[name]) for own, name in called.items()}
    if one_for_all:
        return dict.fromkeys(names, read(given))
    raise InputError(
        f"The {what} are {shorten(given)}: give them by the name of each {of}, for example "
        f"{example}."
    )


def as_given(value: Any) -> Any:
    """Return what is given: for what is read later, with others beside it."""
    return value
