"""What the exercises on laws ask about: which powers, which laws, which shares."""

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class LawNumbers:
    """What varies in an exercise whose answer belongs to a law, and not to a machine.

    `powers` are those of x in 02.2; in 05.2 the peak of the first of the laws `compared` is
    smaller than that of the second; `fastest` is Cv in 05.4. The hammer of 06.1 sets off with
    `head_start` times its mean velocity, and in 06.2 nothing pushes for the share `pause` of the
    time. As they stand here they are those of the source.

    >>> LawNumbers().powers, LawNumbers().compared
    ((2, 3), ('modified trapezoid', 'cycloidal'))
    """

    powers: tuple[int, int] = (2, 3)
    compared: tuple[str, str] = ("modified trapezoid", "cycloidal")
    fastest: float = 2
    head_start: float = 0
    pause: float = 0
