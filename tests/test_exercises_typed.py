"""Numbers that a reader typed, with the reason that each has to get, and what none may be told.

All were worked out on paper: with another law, without the hole, with a time that was rounded.
"""

import re

import pytest
from judging import say

from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.variants import machine_for

TYPED = [
    ("01.3", "", 0.3923, "degrees of its work are not free"),
    ("02.4", "", 0.33, "^This is by how much it grows"),  # a quarter of the right number is 0.3328
    ("02.1", "Zoë", 0.341, "velocity.* Or: This is the acceleration in g"),
    ("12.1", "Anna", 4185, "^This compares the velocities[^.]*[.][^.]*[.]$"),
    ("12.1", "s0", 3679.3, "mill got another angle.* Or: Close.*rounded on the way"),
    ("12.2", "Learner0", 7.84, "^These are way and angle of the lesson's sucker[^O]*$"),
    ("08.1", "", 27.1558, "^Here the plate has no hole"),
    ("08.2", "", 308.744, "^With a wrong answer to 08.1 .* has no hole"),
    ("08.3", "", 107.877, "^With a wrong answer to 08.1 .* has no hole"),
    ("08.3", "", 111.13, "^This is the modified trapezoid"),
    ("08.3", "", 74.974, "^This is the modified sine"),
    ("08.2", "", 297.34, "^This is the 3-4-5 polynomial"),
    ("08.3", "", 91.8, "^This is what the lesson's table asks, with its friction"),
    ("05.2", "", 22, "machine of the lesson"),
    ("05.3", "", 73.024, "^So many it would need if it moved by the cycloid"),
    ("10.1", "Ben", 264.84, "hundredth of a second"),
    ("10.2", "", 1.13728, "^The jumps are half a move apart"),
    ("10.3", "", 374.058, "sine counts in degrees"),
    ("10.3", "Anna", 1052.47, "sine counts in degrees"),
    ("10.3", "Ben", 892.33, "sine counts in degrees"),
    ("10.4", "", 17.4346, "^The squares of two periods were added, each of a mass on"),
    ("11.2", "Chris", 160, "^This is with the grade of the hole for both"),
    ("11.2", "Chris", 138, "^This is with the grade of the shaft for both"),
    ("08.3", "", 167.124, "^The friction on the table was added"),
    ("08.2", "Ben", 197.21263, "With a wrong answer to 08.1 .* plate alone"),
]


@pytest.mark.parametrize(("number", "who", "typed", "said"), TYPED)
def test_what_was_typed_gets_its_reason(number: str, who: str, typed: float, said: str) -> None:
    assert re.search(said, say(EXERCISES[number], typed, machine_for(who)))


def test_a_sum_of_whole_numbers_from_a_table_was_not_rounded_on_the_way() -> None:
    for off in (1, -1, 6):
        typed = EXERCISES["11.2"].solution(machine_for("Anna")) + off
        said = say(EXERCISES["11.2"], typed, machine_for("Anna"))
        assert "keep all digits" not in said.casefold()
