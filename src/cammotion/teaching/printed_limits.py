"""A page of limits with errors in it, for the hunt in notebook 11.

Some errors were printed: in ISO 286-2:1988, which a corrigendum of 2006 put right, and in tables
that are in use. Some are planted. Which ones they are is for the learner to find out, by a test.
"""

import re
from dataclasses import dataclass

from cammotion.arguments import checked
from cammotion.hardware.fits import ZONE, as_written, read_deviation
from cammotion.quantities import InputError, Quantity, keep_numbers, shorten

_END = Quantity("end of a step of diameters", "mm", example=30, low_included=True)


@checked
@dataclass(frozen=True, repr=False)
class PrintedLimits:
    """A line of a table: the limits in um of a zone, for diameters over one to another, in mm.

    Raises InputError for a zone that is no letter with a grade, and for a step of no diameters.

    >>> PrintedLimits("g6", 30, 50, -9, -25)
    g6 over 30 to 50 mm: -9/-25 µm
    """

    zone: str
    over_mm: int
    to_mm: int
    upper_um: float
    lower_um: float

    def __post_init__(self) -> None:
        keep_numbers(
            self,
            over_mm=_END.whole,
            to_mm=_END.whole,
            upper_um=read_deviation,
            lower_um=read_deviation,
        )
        if not re.fullmatch(ZONE, self.zone):
            raise InputError(
                f"The zone is {shorten(self.zone)}: give a letter and a grade, for example 'g6'."
            )
        if self.over_mm >= self.to_mm:
            raise InputError(
                f"The step of diameters goes from {self.over_mm} to {self.to_mm} mm: give the "
                "smaller one as over_mm."
            )

    def __repr__(self) -> str:
        """Write the line."""
        limits = f"{as_written(self.upper_um)}/{as_written(self.lower_um)} µm"
        return f"{self.zone} over {self.over_mm} to {self.to_mm} mm: {limits}"

    @property
    def letter(self) -> str:
        """The letter of the zone."""
        return re.sub(r"\d", "", self.zone)

    @property
    def grade(self) -> int:
        """The grade of the zone."""
        return int(re.sub(r"\D", "", self.zone))


PRINTED_LIMITS = (
    PrintedLimits("d9", 18, 30, -65, -117),
    PrintedLimits("E7", 315, 400, 185, 125),
    PrintedLimits("E8", 80, 120, 125, 72),
    PrintedLimits("f6", 30, 50, -25, -41),
    PrintedLimits("f6", 120, 180, -43, -48),
    PrintedLimits("f7", 50, 80, -30, -60),
    PrintedLimits("f9", 250, 315, -56, -185),
    PrintedLimits("F8", 18, 30, 53, 20),
    PrintedLimits("g5", 80, 120, -12, -27),
    PrintedLimits("g6", 18, 30, -7, -20),
    PrintedLimits("g6", 30, 50, -9, -25),
    PrintedLimits("G7", 3, 6, 14, 2),
    PrintedLimits("G7", 30, 50, 34, 9),
    PrintedLimits("h6", 10, 18, 0, -11),
    PrintedLimits("h7", 120, 180, 0, -40),
    PrintedLimits("H7", 50, 80, 30, 0),
    PrintedLimits("H8", 250, 315, 18, 0),
    PrintedLimits("k6", 30, 50, 18, 2),
    PrintedLimits("K6", 6, 10, 2, -6),
    PrintedLimits("m6", 18, 30, 21, 8),
    PrintedLimits("n6", 50, 80, 39, 20),
    PrintedLimits("p6", 80, 120, 95, 37),
    PrintedLimits("p6", 180, 250, 79, 50),
    PrintedLimits("R10", 18, 30, -10, -112),
)
"""Twenty-four lines; how many of them are wrong is the question of notebook 11."""
