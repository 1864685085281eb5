"""What the lessons let predict."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Prediction:
    """A prediction of a lesson, as `cm.predict(key, asked)` asks for it, and what turns out true.

    `true` is a number in the unit that `asked` names, or a text where no single number is asked
    for. All of them are about the machine of the lessons, with the same numbers for everybody.
    """

    key: str
    asked: str
    true: float | str
