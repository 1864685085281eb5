"""Exercises of notebook 11, fits."""

import math

from cammotion.hardware.fits import (
    Fit,
    deviation_um,
    grade_um,
    limits_of,
    mean_diameter_mm,
    size_step_mm,
    tolerance_unit,
)
from cammotion.machine.kinematics import DEG_PER_TURN, UM_PER_MM
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Slip
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.shown.bars import turn_by_play

_KEY_GRADE = 9
_NO_MORE = 0.004  # than what an answer may be off
_A_MICROMETRE_IS_WRONG = 0.001  # what an answer of some hundred of them may be off
_A_MICROMETRE_IN_500 = 0.002
_NO_SLIP = 0.005  # a diameter that changes less than this leads to the right number
_ANOTHER_ROW = (
    "This is from a row beside the right one. A row ends with its second number, and the next "
    "begins above it."
)
_SIGN_LOST = "A sign is lost: the shaft's deviation is below zero, and is taken away."
_BY_THE_FORMULA = (
    "This is by the formulas. What is asked for is by the table: in it the parts are rounded."
)


def _radius(m: MillAndDie) -> float:
    return m.fits.shaft[0] / 2


def _allowed(m: MillAndDie) -> float:
    """Return the play in um with which a cam turns as far as it may."""
    return math.radians(m.fits.lag_deg) * _radius(m) * UM_PER_MM


def _fit(m: MillAndDie) -> Fit:
    return Fit(f"{m.fits.bore_mm} {'/'.join(m.fits.pair)}")


def _sign_lost(m: MillAndDie) -> float:
    """Return the sum of two deviations of 11.2, below 0 where the shaft's is the larger one."""
    return _fit(m).hole.upper_um + _fit(m).shaft.lower_um


def _unit_at(mean_mm: float) -> float:
    """Return the tolerance unit in um that a mean diameter leads to."""
    return float(0.45 * mean_mm ** (1 / 3) + 0.001 * mean_mm)


def _formula(m: MillAndDie) -> float:
    return grade_um(m.fits.turned_mm, m.fits.grade)


def _units(m: MillAndDie) -> float:
    """Return how many tolerance units the grade has."""
    return _formula(m) / tolerance_unit(m.fits.turned_mm)


def _formula_at(m: MillAndDie, mean_mm: float) -> float:
    """Return what the formula gives for another mean diameter."""
    wrong = _units(m) * _unit_at(mean_mm)
    return wrong if abs(wrong / _formula(m) - 1) > _NO_SLIP else math.nan


def _with_rounded_unit(m: MillAndDie) -> float:
    """Return it with the tolerance unit to a tenth of a um, NaN where that is as good."""
    wrong = _units(m) * round(tolerance_unit(m.fits.turned_mm), 1)
    return _unless_alike(wrong, _formula(m), _A_MICROMETRE_IN_500)


def _with_rounded_mean(m: MillAndDie) -> float:
    """Return it with the mean diameter to a mm, NaN where that is as good."""
    wrong = _units(m) * _unit_at(round(mean_diameter_mm(m.fits.turned_mm)))
    return _unless_alike(wrong, _formula(m), _A_MICROMETRE_IN_500)


def _by_the_table(m: MillAndDie) -> float:
    """Return the width in the table, NaN where that is as good."""
    width = limits_of(f"{m.fits.turned_mm} H{m.fits.grade}").width_um
    return _unless_alike(width, _formula(m), _A_MICROMETRE_IN_500)


def _most_by_the_formulas(m: MillAndDie) -> float:
    """Return the largest play of 11.2 by the formulas, NaN where the table has it too."""
    hole, shaft = m.fits.pair
    widths = sum(grade_um(m.fits.bore_mm, int(zone[1:])) for zone in (hole, shaft))
    most = widths - deviation_um(m.fits.bore_mm, shaft[0])
    return _unless_alike(most, _fit(m).largest_clearance_um, _A_MICROMETRE_IS_WRONG)


def _step(m: MillAndDie) -> tuple[float, float]:
    """Return between which diameters in mm that of 11.2 lies; a step has its upper end."""
    return size_step_mm(m.fits.bore_mm)


def _most_of(m: MillAndDie, diameter_mm: float) -> float:
    """Return the largest play of the zones of 11.2 at another diameter, in um."""
    return Fit(f"{diameter_mm:g} {'/'.join(m.fits.pair)}").largest_clearance_um


def _key_by_the_formula(m: MillAndDie) -> float:
    """Return the largest play of the key by the formula, NaN where the table has it too."""
    return _unless_alike(2 * grade_um(m.fits.shaft[1], _KEY_GRADE), _key_um(m))


def _unless_alike(wrong: float, right: float, within: float = _NO_MORE) -> float:
    """Return a wrong number, NaN if it is as good as the right one."""
    return math.nan if math.isclose(wrong, right, rel_tol=within) else wrong


def _coarser(m: MillAndDie) -> float:
    return grade_um(m.fits.turned_mm, m.fits.grade + 1)


def _finer(m: MillAndDie) -> float:
    return grade_um(m.fits.turned_mm, m.fits.grade - 1)


def _key_um(m: MillAndDie, width_mm: float | None = None) -> float:
    """Return the largest play of the key in its keyway, or of one of another width."""
    width = m.fits.shaft[1] if width_mm is None else width_mm
    return Fit(f"{width:g} H{_KEY_GRADE}/h{_KEY_GRADE}").largest_clearance_um


def _key_step(m: MillAndDie) -> tuple[float, float]:
    """Return between which widths in mm the key lies; a step has its upper end."""
    return size_step_mm(m.fits.shaft[1])


def _turned(m: MillAndDie, play_um: float) -> float:
    """Return by how many deg a cam turns with a play at its shaft."""
    return math.degrees(play_um / UM_PER_MM / _radius(m))


EXERCISES = (
    NumberExercise(
        number="11.1",
        question=lambda m: (
            f"A cam sits on a shaft of {m.fits.shaft[0]} mm. From one end of its play to the other "
            f"it may turn by {m.fits.lag_deg:g} degrees. How much play may it have, measured along "
            "the circumference of the shaft?"
        ),
        unit="µm",
        answer=_allowed,
        shows=turn_by_play(lambda m: m.fits.lag_deg, _radius),
        right="Hundredths of a degree are micrometres here: so closely a key has to fit.",
        slips=(
            Slip(
                lambda m: 2 * _allowed(m),
                "Here the diameter was taken for the radius. How far is the circumference from the "
                "axis?",
            ),
            Slip(
                lambda m: _allowed(m) / 2,
                "This is half of it. The angle is already that from one end to the other.",
            ),
            Slip(
                lambda m: _allowed(m) / 2,
                "The circumference is pi times the diameter, and was taken as pi times the radius.",
            ),
            Slip(
                lambda m: m.fits.lag_deg * _radius(m) * UM_PER_MM,
                "An arc is the radius times the angle in radians. This was with degrees.",
            ),
            Slip(
                lambda m: m.fits.lag_deg * 2 * _radius(m) * UM_PER_MM,
                "The angle is in degrees here, and the diameter was taken for the radius.",
            ),
            Slip(
                lambda m: m.fits.lag_deg / DEG_PER_TURN * 2 * _radius(m) * UM_PER_MM,
                "The share of the turn is right, but a turn is pi times the diameter.",
            ),
            Slip(
                lambda m: _allowed(m) / UM_PER_MM,
                "This is in mm. Micrometres are asked for.",
            ),
            Slip(
                lambda m: m.fits.lag_deg / DEG_PER_TURN * UM_PER_MM,
                "This is a share of a turn. How long is the whole circumference?",
            ),
            Slip(
                lambda m: math.degrees(m.fits.lag_deg) * _radius(m) * UM_PER_MM,
                "To make radians of degrees multiply by pi/180. Here it was divided.",
            ),
            Slip(
                lambda m: math.radians(m.fits.lag_deg) * UM_PER_MM,
                "The radius of the shaft is not in it.",
            ),
            Slip(
                lambda m: math.radians(m.fits.lag_deg) / _radius(m) * UM_PER_MM,
                "This was divided by the radius. With a thicker shaft, has the cam more room or "
                "less?",
            ),
        ),
        hints=(
            "How long is an arc of so many degrees on a circle?",
            "An arc is the angle, in radians, times the radius.",
            "The radius is half of the diameter; a mm has a thousand µm.",
        ),
    ),
    NumberExercise(
        number="11.2",
        question=lambda m: (
            f"Your cam has a bore of {m.fits.bore_mm} {m.fits.pair[0]}, the shaft is "
            f"{m.fits.bore_mm} {m.fits.pair[1]}, both by the table. How much play may the two have "
            "at most, in diameter?"
        ),
        unit="µm",
        answer=lambda m: _fit(m).largest_clearance_um,
        tolerance=_A_MICROMETRE_IS_WRONG,
        is_count=True,
        right="Two parts that are both good can be so far apart.",
        slips=(
            Slip(
                lambda m: _fit(m).smallest_clearance_um,
                "This is the least play that they have: the tightest hole and the thickest shaft.",
            ),
            Slip(
                lambda m: _fit(m).hole.width_um + _fit(m).shaft.width_um,
                "These are the two tolerances. The gap between the zones belongs to it too.",
            ),
            Slip(
                lambda m: _fit(m).hole.upper_um,
                "This is how far the hole is above the zero line. Where does the shaft's zone end?",
            ),
            Slip(
                lambda m: -_fit(m).shaft.lower_um,
                "This is how far the shaft is below the zero line. The hole is above it.",
            ),
            Slip(
                lambda m: _fit(m).hole.upper_um - _fit(m).shaft.upper_um,
                "Here the thickest shaft is in the largest hole. Which shaft leaves most room?",
            ),
            Slip(_sign_lost, _SIGN_LOST),
            Slip(lambda m: abs(_sign_lost(m)), _SIGN_LOST),
            Slip(
                lambda m: 2 * _fit(m).hole.width_um - _fit(m).shaft.upper_um,
                "This is with the grade of the hole for both. The shaft has a grade of its own, "
                "the number after its letter.",
            ),
            Slip(
                lambda m: 2 * _fit(m).shaft.width_um - _fit(m).shaft.upper_um,
                "This is with the grade of the shaft for both. The hole has a grade of its own, "
                "the number after its letter.",
            ),
            Slip(_most_by_the_formulas, _BY_THE_FORMULA),
            Slip(lambda m: _most_of(m, _step(m)[0]), _ANOTHER_ROW),
            Slip(lambda m: _most_of(m, _step(m)[1] + 1), _ANOTHER_ROW),
            Slip(
                lambda m: (_fit(m).largest_clearance_um + _fit(m).smallest_clearance_um) / 2,
                "This is the play in the mean. What is asked for is the most that can happen.",
            ),
            Slip(
                lambda m: _fit(m).largest_clearance_um / UM_PER_MM,
                "This is in mm. Micrometres are asked for.",
            ),
            Slip(
                lambda m: _fit(m).largest_clearance_um / 2,
                "This is the gap on one side. The play is asked for in diameter.",
            ),
            Slip(
                lambda m: m.fits.bore_mm + _fit(m).largest_clearance_um / UM_PER_MM,
                "The diameter was added. How much larger is the hole than the shaft?",
            ),
            Slip(
                lambda m: _fit(m).shaft.width_um,
                "This is the tolerance of the shaft alone.",
            ),
            Slip(
                lambda m: _fit(m).hole.width_um - _fit(m).shaft.upper_um - _fit(m).shaft.width_um,
                "The shaft's tolerance was taken away. A thinner shaft leaves more room.",
            ),
        ),
        hints=(
            "Which hole, and which shaft, leave the most room between them?",
            "It is the largest hole with the thinnest shaft.",
            "Take the lower deviation of the shaft away from the upper one of the hole; "
            "cm.limits_of knows both, and so does any table of ISO 286-2.",
        ),
    ),
    NumberExercise(
        number="11.3",
        question=lambda m: (
            f"By the formula, not by the table: how wide is grade {m.fits.grade} at "
            f"{m.fits.turned_mm} mm? Your step goes from {size_step_mm(m.fits.turned_mm)[0]:g} to "
            f"{size_step_mm(m.fits.turned_mm)[1]:g} mm."
        ),
        unit="µm",
        answer=_formula,
        tolerance=_A_MICROMETRE_IN_500,
        right="The table is only a rounding away, but it rounds by rules of its own.",
        slips=(
            Slip(
                lambda m: _formula_at(m, m.fits.turned_mm),
                "Here the diameter itself was put in. D is one number for the whole step.",
            ),
            Slip(
                lambda m: _formula_at(m, sum(size_step_mm(m.fits.turned_mm)) / 2),
                "This is with the arithmetic mean of the step. D is the geometric one, the root of "
                "the product.",
            ),
            Slip(
                lambda m: _formula_at(m, size_step_mm(m.fits.turned_mm)[0]),
                "This is with the lower end of the step.",
            ),
            Slip(
                lambda m: _formula_at(m, size_step_mm(m.fits.turned_mm)[1]),
                "This is with the upper end of the step.",
            ),
            Slip(
                lambda m: tolerance_unit(m.fits.turned_mm),
                "This is the tolerance unit i. How many of them has the grade?",
            ),
            Slip(
                _with_rounded_unit,
                "The tolerance unit was rounded on the way: keep all digits until the end.",
            ),
            Slip(
                lambda m: m.fits.grade * tolerance_unit(m.fits.turned_mm),
                "The number of the grade is no factor. Grade 6 has ten units, and each grade "
                "after it about 1.6 times as many as the one before.",
            ),
            Slip(
                _by_the_table,
                "This is what the table says, in which the width is rounded. The formula is asked "
                "for, and not rounded to whole µm.",
            ),
            Slip(_with_rounded_mean, "D was rounded on the way: keep all digits until the end."),
            Slip(_coarser, "This is one grade too coarse."),
            Slip(_finer, "This is one grade too fine."),
            Slip(
                lambda m: _units(m) * 0.45 * mean_diameter_mm(m.fits.turned_mm) ** (1 / 3),
                "The second term, a thousandth of D, is missing.",
            ),
            Slip(
                lambda m: (
                    _units(m)
                    * (
                        0.45 * math.sqrt(mean_diameter_mm(m.fits.turned_mm))
                        + 0.001 * mean_diameter_mm(m.fits.turned_mm)
                    )
                ),
                "This is with the square root of D. The formula has the cube root.",
            ),
            Slip(
                lambda m: _formula(m) / UM_PER_MM,
                "This is in mm. Micrometres are asked for.",
            ),
            Slip(
                lambda m: _units(m) * (0.45 / 3 + 0.001) * mean_diameter_mm(m.fits.turned_mm),
                "Here D was divided by three. The formula has its cube root; in Python that is "
                "D ** (1 / 3).",
            ),
        ),
        hints=(
            "D is the geometric mean of the two ends of the step.",
            "The tolerance unit is 0.45 times the cube root of D, and a thousandth of D.",
            "The table in the lesson says how many units each grade has.",
        ),
    ),
    NumberExercise(
        number="11.4",
        question=lambda m: (
            f"A cam is held by a key, {m.fits.shaft[1]} mm wide and made to h9. It sits "
            "fast in the shaft; the keyway in the cam is made to H9. By how many degrees can the "
            "cam turn at most, from one end to the other, if the key pushes at the circumference "
            f"of the shaft of {m.fits.shaft[0]} mm?"
        ),
        unit="deg",
        answer=lambda m: _turned(m, _key_um(m)),
        right="A cam that may turn less than this needs a closer keyway, or has to be pressed on.",
        slips=(
            Slip(
                lambda m: _turned(m, _key_um(m)) / 2,
                "This is half of it: was the diameter taken for the radius, or only one of the two "
                "tolerances?",
            ),
            Slip(
                lambda m: _turned(m, _key_um(m)) / 4,
                "This is a quarter of it: the diameter was taken for the radius, and only one of "
                "the two tolerances.",
            ),
            Slip(
                lambda m: 2 * _turned(m, _key_um(m)),
                "This is twice as much: to and fro together are one play.",
            ),
            Slip(
                lambda m: 2 * _turned(m, _key_um(m)),
                "A turn is pi times the diameter, and was taken as pi times the radius.",
            ),
            Slip(
                lambda m: _turned(m, _key_um(m)) * math.pi,
                "A pi is lost: a turn is pi times the diameter, and a rad is 180/pi degrees.",
            ),
            Slip(
                lambda m: _turned(m, _key_by_the_formula(m)),
                "This is by the formula. A drawing goes by the table, in which the width is "
                "rounded.",
            ),
            Slip(lambda m: _turned(m, _key_um(m, _key_step(m)[0])), _ANOTHER_ROW),
            Slip(lambda m: _turned(m, _key_um(m, _key_step(m)[1] + 1)), _ANOTHER_ROW),
            Slip(
                lambda m: math.radians(_turned(m, _key_um(m))),
                "This is in radians. Degrees are asked for.",
            ),
            Slip(
                lambda m: _turned(m, 2 * limits_of(f"{m.fits.shaft[0]} h{_KEY_GRADE}").width_um),
                "This is with the diameter of the shaft. The limits belong to the width of the "
                "key.",
            ),
            Slip(
                lambda m: _turned(m, limits_of(f"{m.fits.shaft[0]} h{_KEY_GRADE}").width_um),
                "This is one tolerance, by the diameter of the shaft. The limits belong to the "
                "width of the key, and there are two.",
            ),
            Slip(
                lambda m: math.degrees(2 * _key_um(m) / UM_PER_MM / m.fits.shaft[1]),
                "Here the play was divided by half the width of the key. It works at the radius of "
                "the shaft.",
            ),
            Slip(
                lambda m: math.degrees(_key_um(m) / UM_PER_MM / m.fits.shaft[1]),
                "Here the play was divided by the width of the key. It works at the radius of the "
                "shaft.",
            ),
            Slip(
                lambda m: _turned(m, _key_um(m)) * UM_PER_MM,
                "Micrometres were divided by millimetres.",
            ),
            Slip(
                _key_um,
                "This is the play in µm. How far does it let the cam turn?",
            ),
            Slip(
                lambda m: _key_um(m) / UM_PER_MM,
                "This is the play in mm. How far does it let the cam turn?",
            ),
            Slip(
                lambda m: _turned(m, Fit(f"{m.fits.shaft[1]} H7/h7").largest_clearance_um),
                "This is with grade 7. Key and keyway have grade 9 here.",
            ),
        ),
        hints=(
            "How much wider than the key can the keyway be?",
            "It is the largest play of a fit H9/h9, and its nominal size is the width of the key.",
            "Divide it, in mm, by the radius of the shaft, and make degrees of it.",
        ),
    ),
    ChoiceExercise(
        number="11.5",
        question=lambda m: (
            "A locating pin of 3 mm is to be pressed into the cam, 3 H7/p6. What do two good parts "
            "do, by the table?"
        ),
        options={
            "a": "The pin is always thicker than the hole: p6 is a press fit.",
            "b": "The pin may be loose, or it may be tight.",
            "c": "The pin is never thicker than the hole.",
            "d": "The pin always has the size of the hole, to the µm.",
        },
        answer="b",
        reasons={
            "a": "So it is at 40 mm. Where does the zone of H7 end at 3 mm, and where does p6 "
            "begin?",
            "c": "The upper deviation of p6 is above zero, and a hole of H7 may be as small as its "
            "nominal size. What then?",
            "d": "Each part may lie anywhere in its zone, and hole and pin have different ones. "
            "Where are they at 3 mm?",
        },
        right="A letter is a promise only together with its step: look before you press.",
        hints=(
            "What are the limits of 3 H7, and of 3 p6?",
            "Do the two zones overlap?",
            "Put the largest hole on the thinnest pin, then the smallest hole on the thickest.",
        ),
    ),
)

PREDICTIONS = (
    Prediction(
        "11.play",
        "deg of cam angle",
        0.143,
        "Five hundredths of a millimetre sound like nothing. But a degree at this radius is only a "
        "third of a millimetre.",
        also=(0.14,),  # as the lesson writes it
    ),
    Prediction(
        "11.press",
        "a letter",
        "p",
        "m and n lie above the zero line, and that looks as if it were enough. But a hole may be "
        "above it too, by its whole tolerance.",
    ),
    Prediction(
        "11.errors",
        "lines out of 24",
        8,
        "In a standard one expects none, or one. But a table of thousands of numbers is typed, or "
        "set, by people.",
    ),
)
