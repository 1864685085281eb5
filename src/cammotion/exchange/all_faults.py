"""All that is wrong with a table, said at once."""

from collections.abc import Iterator
from contextlib import contextmanager

from cammotion.quantities import InputError

_LONGEST = 900  # characters; who mends these reads the table again


class Faults:
    """The sentences of what is wrong, in the order in which it was found.

    >>> faults = Faults()
    >>> with faults.at("Line 3"):
    ...     raise InputError("The stroke is -5 mm: give 50.")
    >>> faults.check()
    Traceback (most recent call last):
    cammotion.InputError: Line 3: The stroke is -5 mm: give 50.
    """

    def __init__(self) -> None:
        self._found: dict[str, None] = {}

    def add(self, sentence: str) -> None:
        """Keep a sentence, once."""
        self._found[sentence] = None

    @contextmanager
    def at(self, where: str = "") -> Iterator[None]:
        """Keep the sentence of an InputError, with the place before it, and go on."""
        try:
            yield
        except InputError as wrong:
            self.add(f"{where}: {wrong}" if where else str(wrong))

    def check(self) -> None:
        """Raise one InputError with all sentences, a line each, as far as they can be read."""
        found = [*self._found]
        if not found:
            return
        told = found[:1]
        for sentence in found[1:]:
            if sum(map(len, told)) + len(sentence) > _LONGEST:
                break
            told.append(sentence)
        if left := len(found) - len(told):
            told.append(f"And {left} more: mend these first.")
        raise InputError("\n".join(told))
