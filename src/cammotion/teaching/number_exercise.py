"""Exercises that ask for a number, and why a number is wrong."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, NamedTuple

from cammotion.machine.kinematics import MM_PER_M, STANDARD_GRAVITY
from cammotion.quantities import InputError
from cammotion.teaching.copied import with_lessons_numbers
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.exercise import Exercise, Slip, led_to
from cammotion.teaching.reading import to_number
from cammotion.teaching.reasons import COMMON_RATIOS, RATIOS_OF_SUMS, UNIT_RATIOS, in_one, those_in
from cammotion.teaching.rounding import (
    FEWEST,
    MOST,
    MOST_OFF,
    digits_needed,
    is_as_typed,
    is_rounded,
    is_same,
)
from cammotion.teaching.shown.frame import Shows

GoingOn = Callable[[MillAndDie, float], float]
"""How an answer comes out of the answer to an earlier exercise."""
EXACT = 7  # digits: a number that agrees in so many is the answer, whatever leads near to it
ROUND_G = 10  # m/s2, as one reckons in the head
NEAR, NOT_FAR = 0.02, 0.08  # so near it is the rounding, or most likely is
_CLOSE = (
    "Close, but off by {} %. That is often a number that was rounded on the way: keep all digits "
    "until the end."
)
_OFF = (
    "Not far, but off by {} %. Was a number rounded on the way, or one read off wrongly? Keep all "
    "digits until the end."
)
_SIGN_AND_SIZE = "The sign is wrong, and so is the size. Which way does it go?"
_IN_G = "This is the acceleration in g. It is asked for in m/s²."
_TOO_FEW = (
    "With so few digits this cannot be told from an answer that went wrong. If it has no more of "
    "them, a number was rounded on the way: keep all digits until the end. Else give {} digits at "
    "least."
)
WITH_WRONG = "With a wrong answer to {} this would be right."
WITH_LESSONS = "With the lesson's answer to {} in place of yours this would be right."
_RIGHT_BUT = "What you did here is right, but"
YOURS = f"{_RIGHT_BUT} with your {{}} from {{}}, which was not right yet."
OF_THE_LESSON = "This is right for the machine of the lesson. Yours has other numbers."
MIXED = (
    "With a number of the lesson's machine in place of one of yours this would be right. Are all "
    "the numbers that you put in those of your question?"
)
_IN_MM_TOO: Mapping[str, str] = {  # what makes a product a thousand times as large, by its unit
    "m/s²": "{} Besides, a length is in mm where metres belong.",
    "N": "{} Besides, a length is in mm where metres belong, or a mass in grams.",
}
_DIGITS = {3: "three", 4: "four"}


@dataclass(frozen=True)
class Carried(Slip):
    """What an earlier exercise leads to in a later one, with the exercises that it goes through.

    It is a slip there, whose reason is the `cause`, or the wrong answer that a learner gave.
    """

    through: tuple[str, ...]
    cause: str = ""


@dataclass(frozen=True, kw_only=True)
class NumberExercise(Exercise):
    """A number with a unit, right within `tolerance`, a share of it, where no slip is nearer.

    It is not right by the tolerance alone if the lesson's numbers, or an earlier slip, lead to it.
    It may be rounded to as few digits as tell it from the slips, see `digits_needed`. `mixed` is
    what it is with numbers of the lesson that are no number of its machine: what follows from
    several of them and is printed, or belongs to another part. `also` is the answer from a number
    with more digits than the question prints, which is as right as it is given.
    `lessons` is the lesson's answer where that is not the one of its machine, NaN if it has none.
    `goes_on_from` says how it comes out of earlier answers, by their numbers. `carried` is what it
    then is with their slips, and `brought` what it is with wrong answers that this learner gave;
    see `link` and `after`. `shows` draws what a number would do in the machine. A sum, `is_sum`, or
    what is as plain has neither a factor pi nor squares in it that could be lost; one that
    `is_product` has a length for a factor, with which all of it grows; of a whole number,
    `is_count`, nothing is rounded on the way; in one that `is_quotient`, of two like numbers, what
    they share cancels, so that a factor pi is met by chance: a ratio is told only where it agrees
    to the digits given.
    """

    unit: str
    answer: Callable[[MillAndDie], float]
    slips: tuple[Slip, ...] = ()
    tolerance: float = 0.004
    goes_on_from: Mapping[str, GoingOn] = field(default_factory=dict, hash=False)
    carried: tuple[Carried, ...] = ()
    brought: tuple[Carried, ...] = ()
    mixed: Callable[[MillAndDie], Iterable[float]] = lambda _: ()
    also: Callable[[MillAndDie], float] | None = None
    lessons: Callable[[], float] | None = None
    shows: Shows | None = None
    is_sum: bool = False
    is_product: bool = False
    is_count: bool = False
    is_quotient: bool = False

    @property
    def wanted(self) -> str:
        """What kind of answer is asked for, in words."""
        return f"one number in {self.unit}" if self.unit else "one number"

    def wanted_for(self, machine: MillAndDie) -> str:
        """Return what is asked for, with the number of digits where two are too few."""
        digits = _known(self, machine).digits
        asked = f", to {_DIGITS[digits]} digits" if digits > FEWEST else ""
        return f"{self.wanted}{asked}"

    def solution(self, machine: MillAndDie) -> float:
        """Return the right number for a machine."""
        return float(led_to(self.answer, machine))

    @property
    def ratios(self) -> Mapping[float, str]:
        """Ratios to the right number that betray what has happened, in any unit and in this one."""
        common = RATIOS_OF_SUMS if self.is_sum else COMMON_RATIOS
        return {**common, **UNIT_RATIOS.get(self.unit, {})}

    def of_the_lesson(self, machine: MillAndDie) -> tuple[float, ...]:
        """Return the lesson's answer, and what one of its numbers leads to in place of an own one.

        The lesson's comes first, NaN if it is right. None of the others is.
        """
        return _of_the_lesson(self, machine)

    def find_fault(self, answer: Any, machine: MillAndDie) -> str:
        """Return why a number is wrong; "" if it is right."""
        given = to_number(answer, self.wanted)
        right, wrong, digits = _known(self, machine)
        also = right if self.also is None else led_to(self.also, machine)
        as_asked = range(digits, EXACT + 1)
        is_right = any(is_rounded(given, one, n) for one in (right, also) for n in as_asked)
        if is_right or is_same(given, also):
            return ""
        off = abs(given - right)
        slip = min(wrong, key=lambda value: abs(given - value), default=math.inf)
        is_to_most = is_rounded(float(f"{given:.{MOST}g}"), right, MOST)  # though nearly round
        has_few = any(is_rounded(given, right, fewer) for fewer in range(FEWEST, digits))
        too_few = [_TOO_FEW.format(_DIGITS[digits])] if has_few and not is_to_most else []
        if is_same(given, slip):
            return in_one([*too_few, *self._all_that_lead_to(given, slip, machine)])
        if too_few:
            return in_one(too_few)
        if self._is_about(given, slip) and abs(given - slip) < off:
            known = self._all_that_lead_to(given, slip, machine)
            is_slip = _agrees(given, slip) and not is_as_typed(given, right)
            rounded = [] if is_slip else self._rounded_on_the_way(given, right)
            return in_one([*known, *rounded])
        has_other_way = self._mixed_up(given, machine) or self._carried_to(given, machine)
        if self._is(given, right) and not has_other_way:
            return ""
        return self._explain(given, machine, wrong)

    def _explain(self, given: float, machine: MillAndDie, wrong: Mapping[float, str]) -> str:
        """Say what has happened to a number that is neither right nor one of the slips."""
        right = self.solution(machine)
        mixed_up = self._mixed_up(given, machine, FEWEST + 1)
        is_ratio = is_as_typed if mixed_up else self._is_about
        ratios = [
            said
            for r, said in self.ratios.items()
            if is_ratio(given, r * right) and (not self.is_quotient or _agrees(given, r * right))
        ]
        carried = self._carried_to(given, machine)
        rounded = in_one(
            reason
            for value, reason in wrong.items()
            if is_rounded(given, value, FEWEST) and abs(given - value) <= MOST_OFF * abs(value)
        )
        return (
            in_one(slip.reason for slip in self._brought_along(given, machine))
            or (_IN_G if any(self._is(given, value) for value in self.in_g(right)) else "")
            or in_one([*ratios[:1], *mixed_up])
            or rounded
            or in_one(slip.reason for slip in carried)
            or self._in_mm_too(given, machine, wrong)
            or self._far(given, right)
        )

    def _in_mm_too(self, given: float, machine: MillAndDie, wrong: Mapping[float, str]) -> str:
        """Say what has happened to a product that comes of mm and is wrong in another way, too."""
        if not self.is_product:
            return ""
        given /= MM_PER_M
        reasons = [reason for value, reason in wrong.items() if self._is_about(given, value)] or [
            slip.reason for slip in self.brought if self._is(given, slip.leads_to(machine))
        ]
        return in_one(self._with_mm(one) for each in reasons for one in those_in(each))

    def _with_mm(self, reason: str) -> str:
        """Return a reason with mm beside it, so that not all that was done here is right."""
        return _IN_MM_TOO[self.unit].format(reason.replace(_RIGHT_BUT, "This is"))

    def _all_that_lead_to(self, given: float, slip: float, machine: MillAndDie) -> list[str]:
        """Return why a number is wrong that is a slip's: all reasons that it may have.

        If it is not that slip's as typed, all slips within the tolerance are among them.
        A ratio, or what a slip in an earlier exercise leads to, is among them where it leads to the
        number exactly, and the slip only near it; what is in g, where it agrees, too.
        """
        wrong = _known(self, machine).wrong
        is_between = not _agrees(given, slip)
        alike = [
            value
            for value in wrong
            if is_same(value, slip)
            or (is_between and self._is(given, value))
            or any(is_rounded(given, value, digits) for digits in range(FEWEST + 1, MOST + 1))
        ]
        nearest_first = sorted(
            alike, key=lambda value: (not is_same(value, slip), abs(given - value))
        )
        brought = self._brought_along(given, machine)
        told = tuple(slip.cause for slip in brought if slip.cause)  # "The acceleration is …" + it
        own = (reason for value in nearest_first for reason in those_in(wrong[value]))
        reasons = [reason for reason in own if not reason.endswith(told)]
        right = self.solution(machine)
        ratios = [said for r, said in self.ratios.items() if is_as_typed(given, r * right)]
        earlier = [one.reason for one in self._carried_to(given, machine)]
        in_g = [_IN_G] if any(_agrees(given, value) for value in self.in_g(right)) else []
        exact = [] if is_as_typed(given, slip) else [*ratios, *earlier]
        carried = (slip.reason for slip in brought)
        is_alone = any(slip.alone and slip.reason in reasons for slip in self.slips)
        mixed_up = [] if is_alone else self._mixed_up(given, machine)
        return [*carried, *reasons, *in_g, *mixed_up, *exact]

    def _mixed_up(self, given: float, machine: MillAndDie, digits: int = MOST) -> list[str]:
        """Return what is said if numbers of the lesson's machine lead to a number, at most one.

        The lesson's own answer is one that is typed with so many digits, or nearly all of them.
        """
        lessons, *others = self.of_the_lesson(machine)
        if _is_typed_in(given, lessons, digits):
            return [OF_THE_LESSON]
        return [MIXED] if any(is_as_typed(given, other) for other in others) else []

    def _brought_along(self, given: float, machine: MillAndDie) -> list[Carried]:
        """Return the wrong answers of this learner that lead to a number.

        Where that was a known slip, it is the slip.
        """
        brought = [slip for slip in self.brought if self._is(given, slip.leads_to(machine))]
        numbers = {number for slip in brought for number in slip.through}
        known = [
            slip
            for slip in self._carried_to(given, machine, FEWEST + 1)
            if not numbers.isdisjoint(slip.through)
        ]
        return known or brought

    def _carried_to(self, given: float, machine: MillAndDie, digits: int = MOST) -> list[Carried]:
        right = self.solution(machine)
        return [
            slip
            for slip in self.carried
            if _is_typed_in(given, slip.leads_to(machine), digits)
            and not is_as_typed(slip.leads_to(machine), right)
        ]

    def _is(self, given: float, value: float) -> bool:
        return math.isclose(given, value, rel_tol=self.tolerance, abs_tol=1e-12)

    def _is_about(self, given: float, value: float) -> bool:
        return self._is(given, value) or is_rounded(given, value, FEWEST + 1)

    def in_g(self, right: float) -> tuple[float, ...]:
        """Return an acceleration in g, by the standard one and as one reckons in the head."""
        gs = (STANDARD_GRAVITY, ROUND_G) if self.unit == "m/s²" else ()
        return tuple(right / g for g in gs)

    def _far(self, given: float, right: float) -> str:
        """Say what there is to say of a number with no known history."""
        if rounded := self._rounded_on_the_way(given, right):
            return rounded[0]
        if given * right < 0:
            return _SIGN_AND_SIZE
        return self._too("large" if abs(given) > abs(right) else "small")

    def _rounded_on_the_way(self, given: float, right: float) -> list[str]:
        """Return what is said of a number so near that it may be right but for a rounding."""
        off = abs(given - right) / abs(right)
        if off > NOT_FAR or self.is_count:
            return []
        return [(_CLOSE if off <= NEAR else _OFF).format(f"{100 * off:.2g}")]

    def _too(self, size: str) -> str:
        return (
            f'This is too {size}. Read the question once more; cm.hint("{self.number}") gives a '
            "hint."
        )

    @property
    def faults(self) -> tuple[str, ...]:
        """All that `find_fault` may return, with … in the place of a number that it measures.

        Where it returns several in one they count as the first of them.
        """
        unknown = (
            *map(_TOO_FEW.format, _DIGITS.values()),
            _CLOSE.format("…"),
            _OFF.format("…"),
            _SIGN_AND_SIZE,
            self._too("large"),
            self._too("small"),
        )
        slips = [slip.reason for slip in (*self.slips, *self.carried)]
        slips += [YOURS.format("…", number) for number in self.goes_on_from]
        in_mm = map(self._with_mm, slips if self.is_product else ())
        return (
            *(*slips, *in_mm, _IN_G, *self.ratios.values()),
            *(OF_THE_LESSON, MIXED, *unknown),
        )


def _agrees(given: float, value: float) -> bool:
    """Tell whether a number is a value as one types it, in however many digits."""
    return any(is_as_typed(given, value, digits) for digits in range(FEWEST, MOST + 1))


def _is_typed_in(given: float, value: float, digits: int) -> bool:
    """Tell whether a number is a value as one types it, in so many digits or in the most."""
    return any(is_as_typed(given, value, each) for each in (digits, MOST))


class _Known(NamedTuple):
    """What an answer is held against: the right number, and the slips by what they lead to.

    A slip that leads to the right number is none. `digits` are those that tell them apart.
    """

    right: float
    wrong: Mapping[float, str]
    digits: int


@lru_cache(maxsize=2**12)
def _known(exercise: NumberExercise, machine: MillAndDie) -> _Known:
    """Work out once what each answer of a machine is held against."""
    right = exercise.solution(machine)
    found = [(float(slip.leads_to(machine)), slip.reason) for slip in exercise.slips]
    wrong: dict[float, str] = {}
    for value, reason in found:
        if math.isfinite(value) and not is_same(value, right):
            wrong[value] = in_one([wrong[value], reason]) if value in wrong else reason
    return _Known(right, wrong, digits_needed(right, wrong))


@lru_cache(maxsize=2**12)
def _of_the_lesson(exercise: NumberExercise, machine: MillAndDie) -> tuple[float, ...]:
    """Work out once what the lesson's numbers lead to; see `NumberExercise.of_the_lesson`."""
    right = exercise.solution(machine)

    def solved(one: MillAndDie) -> float:
        try:
            return exercise.solution(one)
        except InputError:  # with these numbers there is no such machine
            return math.nan

    def wrong(value: float) -> float:
        is_wrong = math.isfinite(value) and not is_as_typed(value, right)
        return value if is_wrong else math.nan

    mixed = (*map(solved, with_lessons_numbers(machine)), *exercise.mixed(machine))
    others = dict.fromkeys(map(wrong, mixed))
    lessons = exercise.lessons() if exercise.lessons else solved(EXAMPLE)
    return (wrong(lessons), *filter(math.isfinite, others))
