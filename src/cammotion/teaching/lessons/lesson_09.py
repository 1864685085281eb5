"""Exercises of notebook 09, a measured cam."""

import math

from cammotion.machine.kinematics import (
    DEG_PER_TURN,
    MM_PER_M,
    SECONDS_PER_MINUTE,
    STANDARD_GRAVITY,
)
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Slip
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.shown.bars import error_of_reading

_UM_PER_M = 1e6


def _dt(m: MillAndDie) -> float:
    """Return the time in s from point to point."""
    return SECONDS_PER_MINUTE / (m.measured.per_minute * m.measured.points)


def _step(m: MillAndDie, times: float = 4) -> float:
    """Return the step in um whose half, so many times, makes the limit."""
    return 2 * m.measured.limit * _dt(m) ** 2 / times * _UM_PER_M


def _made(m: MillAndDie, step_um: float) -> float:
    """Return what a step in um can change an acceleration by, in m/s2."""
    return 4 * step_um / 2 / _UM_PER_M / _dt(m) ** 2


def _give(m: MillAndDie) -> float:
    """Return by how much all three parts give way together under the load, in m."""
    return sum(m.measured.gives_mm) / MM_PER_M


def _stiffness(m: MillAndDie) -> float:
    """Return that of all three parts together, in N/m."""
    return m.measured.load_N / _give(m)


def _swings(m: MillAndDie, stiffness: float | None = None) -> float:
    """Return how often the mass on a stiffness in N/m swings in a turn."""
    k = _stiffness(m) if stiffness is None else stiffness
    return math.sqrt(k / m.measured.mass_kg) / (2 * math.pi) * _turn(m)


def _turn(m: MillAndDie) -> float:
    return SECONDS_PER_MINUTE / m.measured.per_minute


def _softest(m: MillAndDie) -> float:
    return m.measured.load_N / max(m.measured.gives_mm) * MM_PER_M


def _without(m: MillAndDie, give_mm: float) -> float:
    """Return the stiffness in N/m that two of the parts would have together."""
    return m.measured.load_N / (sum(m.measured.gives_mm) - give_mm) * MM_PER_M


def _side_by_side(m: MillAndDie) -> float:
    return sum(m.measured.load_N / give for give in m.measured.gives_mm) * MM_PER_M


def _folded(m: MillAndDie) -> int:
    points, rank = m.measured.folded
    return abs(rank - points * round(rank / points))


def _left(m: MillAndDie, power: int = 4) -> float:
    """Return the percentage that is left of the other harmonic, if the rank counts by a power."""
    return 100 / (1 + (100 / m.measured.left[1] - 1) * _ratio(m) ** power)


def _ratio(m: MillAndDie) -> float:
    """Return the other rank over that of which the share is known."""
    return m.measured.left[2] / m.measured.left[0]


def _omega(m: MillAndDie) -> float:
    return 2 * math.pi / _turn(m)


def _height(m: MillAndDie) -> float:
    """Return the acceleration of the parabola over half a turn, in m/s2."""
    return 4 * m.measured.stroke_mm / MM_PER_M * (_omega(m) / math.pi) ** 2


def _wave(m: MillAndDie) -> float:
    """Return the amplitude of its harmonic: that of a square wave."""
    return 4 / math.pi * _height(m) / m.measured.rank


def _cycloid(m: MillAndDie) -> float:
    stroke = m.measured.stroke_mm / MM_PER_M
    return 16 * stroke * _omega(m) ** 2 / (math.pi**2 * (m.measured.rank**2 - 4))


EXERCISES = (
    NumberExercise(
        number="09.1",
        question=lambda m: (
            f"A cam is to be measured at {m.measured.points} evenly spaced angles of its turn, and "
            f"turns {m.measured.per_minute:g} times a minute. The readings are rounded to a "
            "step. How large may the step be, so that the rounding changes no second difference of "
            f"the table, the acceleration, by more than {m.measured.limit:g} m/s²?"
        ),
        unit="µm",
        answer=_step,
        shows=error_of_reading(limit=lambda m: m.measured.limit, made=_made),
        right="With twice as many points it would have to be four times as fine.",
        slips=(
            Slip(
                lambda m: _step(m) / 2,
                "This is the largest error of a reading. Rounding is off by half a step.",
            ),
            Slip(
                lambda m: _step(m, 2),
                "This is for a single reading that is off. Which errors of three do most?",
            ),
            Slip(
                lambda m: _step(m, 1),
                "This is for an error of one neighbour alone. Which errors of three do most?",
            ),
            Slip(
                lambda m: _step(m, 1),
                "The time from point to point was doubled. A velocity has twice of it in it, and a "
                "second difference the square of once.",
            ),
            Slip(
                lambda m: _step(m, 16),
                "Rounding is off by half a step at most. So a step is twice the error, and not "
                "half of it.",
            ),
            Slip(
                lambda m: _step(m, math.sqrt(6)),
                "The root of 6 is for random errors and their mean square. The question asks for "
                "the worst.",
            ),
            Slip(
                lambda m: math.sqrt(12) * m.measured.limit * _dt(m) ** 2 / math.sqrt(6) * _UM_PER_M,
                "This is for random errors, by their mean squares. The question asks for the "
                "worst.",
            ),
            Slip(
                lambda m: 2 * m.measured.limit * _dt(m) / 4 * _UM_PER_M,
                "The time from point to point is squared in a second difference.",
            ),
            Slip(
                lambda m: 2 * m.measured.limit * _turn(m) ** 2 / 4 * _UM_PER_M,
                "This is with the time of a whole turn. Take that from one point to the next.",
            ),
            Slip(
                lambda m: _step(m) / MM_PER_M,
                "This is in mm. The answer is asked for in µm.",
            ),
            Slip(
                lambda m: _step(m) * (m.measured.points / (m.measured.points - 1)) ** 2,
                "The turn was divided by one step less than there are points. After the last point "
                "comes the first again: there are as many steps.",
            ),
            Slip(
                lambda m: _step(m) / SECONDS_PER_MINUTE**2,
                "The time is in minutes here. An acceleration in m/s² wants seconds.",
            ),
            Slip(
                lambda m: _step(m) * (m.measured.points / DEG_PER_TURN) ** 2,
                "The step of the angle was taken for one degree.",
            ),
            Slip(
                lambda m: _step(m) * (2 * math.pi / m.measured.points / _dt(m)) ** 2,
                "The angle from point to point, in rad, was taken for the time. How long does the "
                "cam need for it?",
            ),
            Slip(
                lambda m: _step(m) * (_dt(EXAMPLE) / _dt(m)) ** 2,
                "This is with the time from point to point of the lesson's cam. Yours has another.",
            ),
            Slip(
                lambda m: _step(m) * (2 * math.pi) ** 2,
                "The angle was taken in rad, but not the speed: the time from point to point is "
                "the turn's by the number of points.",
            ),
        ),
        hints=(
            "How long is it from one point to the next, in s?",
            "The worst errors alternate. Their effect is 4 times the error over the square of that "
            "time.",
            "Solve it for the error. A step is twice the largest error of rounding.",
        ),
    ),
    NumberExercise(
        number="09.2",
        question=lambda m: (
            f"Between a cam and a follower of {m.measured.mass_kg:g} kg three parts give way, one "
            "behind the other: by {:g}, {:g} and {:g} mm under a load of ".format(
                *m.measured.gives_mm
            )
            + f"{m.measured.load_N:g} N. The cam turns {m.measured.per_minute:g} times a minute. "
            "How many times would the follower, struck and left alone, swing during a turn?"
        ),
        unit="swings",
        answer=_swings,
        right="The harmonic with the nearest whole number is the one to look at.",
        slips=(
            Slip(
                lambda m: _swings(m, _side_by_side(m)),
                "The stiffnesses were added, as of parts side by side. These are one behind the "
                "other: which of stiffness and give adds up?",
            ),
            Slip(
                lambda m: _swings(m, _softest(m)),
                "This is with the softest part alone. The others give way too.",
            ),
            Slip(
                lambda m: _swings(m, _without(m, max(m.measured.gives_mm))),
                "The softest part was left out. It gives way most of all.",
            ),
            Slip(
                lambda m: _swings(m, _without(m, min(m.measured.gives_mm))),
                "The stiffest part was left out. It gives way too.",
            ),
            Slip(
                lambda m: _swings(m, _stiffness(m) / MM_PER_M),
                "The stiffness is in N/mm here. With kg and s it has to be in N/m.",
            ),
            Slip(
                lambda m: _swings(m) * 2 * math.pi,
                "This is in rad a turn. A swing is 2 pi of it.",
            ),
            Slip(
                lambda m: _swings(m) * 2 * math.pi / _turn(m),
                "This is the angular frequency, in rad a second. A swing is 2 pi of it; and how "
                "long is a turn?",
            ),
            Slip(
                lambda m: _swings(m) / _turn(m),
                "This is in swings a second. How long is a turn?",
            ),
            Slip(
                lambda m: _swings(m) / _turn(m) * SECONDS_PER_MINUTE,
                "This is in swings a minute. How many turns has a minute?",
            ),
            Slip(
                lambda m: 1 / _swings(m),
                "This is how many turns a swing takes. How many swings has a turn?",
            ),
            Slip(
                lambda m: _swings(m) / _turn(m) ** 2,
                "The rate was multiplied. With a faster cam there are fewer swings in a turn.",
            ),
            Slip(
                lambda m: _swings(m) / SECONDS_PER_MINUTE,
                "The turns are by the minute here, and the swings by the second.",
            ),
            Slip(
                lambda m: _swings(m) * math.sqrt(STANDARD_GRAVITY),
                "The mass was divided by g. Kilograms are a mass already; pounds of weight, as in "
                "the lesson, are not.",
            ),
            Slip(
                lambda m: _swings(m) / math.sqrt(STANDARD_GRAVITY),
                "The mass was multiplied by g: this is its weight. The swinging wants the mass.",
            ),
            Slip(
                lambda m: _swings(m) ** 2 / _turn(m) * 2 * math.pi,
                "The root is missing: the frequency is the root of stiffness by mass.",
            ),
            Slip(
                lambda m: math.sqrt(STANDARD_GRAVITY / _give(m)) / (2 * math.pi) * _turn(m),
                "The root of g by the give is for the give under the weight of the follower. This "
                "give belongs to another load, that of the test: which stiffness follows from it?",
            ),
            Slip(
                lambda m: _swings(m, 3 * _stiffness(m)),
                "The give of the three parts was averaged. Do they not add up?",
            ),
        ),
        hints=(
            "By how much do all three give way together, in m, under that load?",
            "The stiffness is load by give. The root of stiffness by mass, over 2 pi, is the "
            "frequency in swings a second.",
            "Times the seconds of a turn it is the number of swings in it.",
        ),
    ),
    NumberExercise(
        number="09.3",
        question=lambda m: (
            f"A cam is measured at {m.measured.folded[0]} evenly spaced angles of its turn. In "
            f"truth its harmonic {m.measured.folded[1]} is strong. As which harmonic will the "
            "table have it?"
        ),
        unit="",
        answer=_folded,
        is_count=True,
        right="Nobody sees by the table that it is not there. Only more points tell.",
        slips=(
            Slip(
                lambda m: m.measured.folded[1],
                "That rank is above Nyquist's limit, and the table has none so high.",
            ),
            Slip(
                lambda m: m.measured.folded[1] - m.measured.folded[0],
                "One turn round the points was taken off. What is left is still above the limit: "
                "it folds back once more.",
            ),
            Slip(
                lambda m: m.measured.folded[0] / 2,
                "This is Nyquist's limit. What is above folds back, as if the limit were a mirror.",
            ),
            Slip(
                lambda m: m.measured.folded[1] - m.measured.folded[0] / 2,
                "This is how far it is above the limit. Where does that lead, from the limit down?",
            ),
            Slip(
                lambda m: m.measured.folded[1] % (m.measured.folded[0] // 2),
                "Halves of the number of points were taken off. Take off whole ones, and then look "
                "at the size of what is left.",
            ),
            Slip(
                lambda m: m.measured.folded[1] + m.measured.folded[0],
                "The points were added. The table has ranks up to half their number only.",
            ),
            Slip(
                lambda m: 3 * m.measured.folded[0] - m.measured.folded[1],
                "This is above the limit, too. Take off whole numbers of points.",
            ),
            Slip(
                lambda m: m.measured.folded[0],
                "This is the number of points. The table has ranks up to half of it only.",
            ),
        ),
        hints=(
            "How far does a wave of that rank turn from one point to the next, in parts of a "
            "swing?",
            "Whole swings between two points cannot be seen. So any multiple of the number of "
            "points can be taken off.",
            "And forwards or backwards cannot be told apart. Which multiple leaves a size of at "
            "most half the number of points?",
        ),
    ),
    NumberExercise(
        number="09.4",
        question=lambda m: (
            "A cam has so many points that the numbers of the smoothing spline are as good as "
            f"1 + λk⁴. An amount of smoothing leaves {m.measured.left[1]} percent of the harmonic "
            f"{m.measured.left[0]}. How many percent does it leave of the harmonic "
            f"{m.measured.left[2]}?"
        ),
        unit="percent",
        answer=_left,
        is_sum=True,
        right="A spline has no edge: it takes from each harmonic, from the faster ones more.",
        slips=(
            Slip(
                lambda m: _left(m, 2),
                "The rank counts with its square here. It is the fourth power.",
            ),
            Slip(lambda m: _left(m, 1), "The rank counts once here. It is the fourth power."),
            Slip(
                lambda m: _left(m, 3),
                "The rank counts with its third power here. It is the fourth.",
            ),
            Slip(
                lambda m: _left(m, -4),
                "The ratio of the ranks is upside down. Is less left of a slower wave, or more?",
            ),
            Slip(
                lambda m: 100 - _left(m),
                "This is what is taken away. What is left is asked for.",
            ),
            Slip(lambda m: _left(m) / 100, "This is a share of 1. Percent are asked for."),
            Slip(
                lambda m: m.measured.left[1],
                "This is the share of the other harmonic.",
            ),
            Slip(
                lambda m: m.measured.left[1] / _ratio(m),
                "This is by simple proportion. What divides the harmonic is 1 + λk⁴.",
            ),
            Slip(
                lambda m: m.measured.left[1] * _ratio(m),
                "This is by simple proportion, upside down: of a slower wave more is left. What "
                "divides the harmonic is 1 + λk⁴.",
            ),
            Slip(
                lambda m: 100 / (1 + (100 / (100 - m.measured.left[1]) - 1) * _ratio(m) ** 4),
                "The percentage was read as what is taken away. It is what is left.",
            ),
            Slip(
                lambda m: 100 / (1 + 100 / m.measured.left[1] * _ratio(m) ** 4),
                "The 1 was forgotten: it is λk⁴, and not 1 + λk⁴, that goes with the fourth power.",
            ),
            Slip(
                lambda m: 100 / ((100 / m.measured.left[1] - 1) * _ratio(m) ** 4),
                "The 1 was not added again: the harmonic is divided by 1 + λk⁴, and not by λk⁴.",
            ),
            Slip(
                lambda m: m.measured.left[1] / _ratio(m) ** 4,
                "The share itself was scaled by the fourth power. It is λk⁴ that goes with it.",
            ),
            Slip(
                lambda m: 100 - (100 - m.measured.left[1]) * _ratio(m) ** 4,
                "What is taken away was scaled by the fourth power. Scale λk⁴, and divide then.",
            ),
            Slip(
                lambda m: 100 - (100 - m.measured.left[1]) * _ratio(m),
                "This is along a straight line. The number is 1 + λk⁴.",
            ),
        ),
        hints=(
            "By which number was the harmonic divided of which you know what is left?",
            "Take off 1, and you have λk⁴ for it. Of the other harmonic it is less, by the fourth "
            "power of the ratio of the ranks.",
            "Add 1 again, and divide 100 percent by it.",
        ),
    ),
    NumberExercise(
        number="09.5",
        question=lambda m: (
            f"A cam lifts its follower by {m.measured.stroke_mm:g} mm in half a turn, by the "
            "constant acceleration, and lets it down in the other half, in the mirror. It turns "
            f"{m.measured.per_minute:g} times a minute. Which amplitude has the harmonic "
            f"{m.measured.rank} of its acceleration?"
        ),
        unit="m/s²",
        answer=_wave,
        right="It falls like 1/k only. A jump in the acceleration has something to say to every "
        "follower.",
        slips=(
            Slip(
                _cycloid,
                "This is the cycloid of the lesson. Take the acceleration of this law, which jumps "
                "from push to brake.",
            ),
            Slip(
                lambda m: _wave(m) * math.pi / 2,
                "This is with the peak of the cycloid, which cm.peak_acceleration takes unless it "
                "is told a law. The height is that of the constant acceleration.",
            ),
            Slip(
                lambda m: _wave(m) * math.pi**2,
                "Half a turn takes the time pi/ω, which is squared: a pi² is lost.",
            ),
            Slip(
                _height,
                "This is the acceleration itself, up and down. How much of that harmonic is in it?",
            ),
            Slip(
                lambda m: _height(m) / m.measured.rank,
                "The harmonic of a square wave is 4/pi of its height by the rank: 4/pi is lost.",
            ),
            Slip(
                lambda m: _wave(m) / 2,
                "This is half of it. The mean of the square of a cosine is a half: twice the mean "
                "of the product is the amplitude.",
            ),
            Slip(
                lambda m: _wave(m) / 2,
                "The integral from 0 to 90 degrees was counted twice. It comes four times.",
            ),
            Slip(
                lambda m: _wave(m) / 2,
                "The peak of this law is 4 times the stroke by the square of the time, not twice: "
                "half the stroke takes half the time.",
            ),
            Slip(
                lambda m: _wave(m) / m.measured.rank,
                "The rank counts once too often. That would be a wave without jumps.",
            ),
            Slip(
                lambda m: _wave(m) * m.measured.rank,
                "This is the first harmonic. The others are smaller.",
            ),
            Slip(
                lambda m: _wave(m) / 4,
                "The peak of this law is 4 times the stroke by the square of the time, not once.",
            ),
            Slip(
                lambda m: _wave(m) / 4,
                "The time of the whole turn was taken. The rise takes half of it.",
            ),
            Slip(
                lambda m: _wave(m) / 4,
                "The integral from 0 to 90 degrees was counted once. It comes four times.",
            ),
            Slip(
                lambda m: _wave(m) * SECONDS_PER_MINUTE**2,
                "Turns a minute were taken for turns a second.",
            ),
            Slip(
                lambda m: _wave(m) * 4,
                "The rise takes half a turn, not a quarter.",
            ),
            Slip(
                lambda m: _wave(m) / (2 * math.pi) ** 2,
                "The 2 pi of the angle is missing: the time of the rise is half a turn's.",
            ),
            Slip(
                lambda m: _wave(m) / (m.measured.rank * _omega(m)) ** 2,
                "This is the harmonic of the displacement, in m. The acceleration's is (kω)² times "
                "as large.",
            ),
            Slip(
                lambda m: _wave(m) / (m.measured.rank * _omega(m)) ** 2 * MM_PER_M,
                "This is the harmonic of the displacement, in mm. The acceleration's is (kω)² "
                "times as large.",
            ),
        ),
        hints=(
            "Draw the acceleration over the whole turn: where does it push, where does it brake?",
            "It is a square wave, up from 270 over 0 to 90 degrees and down in between. Its height "
            "is 4 times the stroke over the square of the time of the rise.",
            "Its harmonic is twice the mean of the height times the cosine, over the turn: the "
            "integral from 0 to 90 degrees is all that you need, four times.",
        ),
    ),
    ChoiceExercise(
        number="09.6",
        question=lambda m: (
            "A cam was measured at 24 evenly spaced angles. Its follower, struck and left alone, "
            "swings 12.1 times during a turn, and it chatters. The twelfth harmonic of the second "
            "differences is only sixth in strength. What may be said?"
        ),
        options={
            "a": "It is no resonance: five harmonics are stronger.",
            "b": "It is resonance, and the twelfth has the amplitude that the table gives.",
            "c": "It may be resonance, but the table does not tell how large the twelfth is.",
            "d": "With 48 angles the same reading errors change the second differences less.",
        },
        answer="c",
        reasons={
            "a": "How much does a resonance with little damping need?",
            "b": "How many points has a swing of the twelfth harmonic?",
            "d": "With half the angle from point to point, what becomes of an error of one "
            "reading in a second difference?",
        },
        right="A frequency that fits, and light damping: little is enough. More points would show "
        "the twelfth, by a Fourier sum, in which the errors of many readings even out.",
        hints=(
            "Which harmonics can be seen whole with 24 points?",
            "How much larger does a follower move at its own frequency, if it is hardly damped?",
            "Which of the sentences says no more than the table can know?",
        ),
    ),
)

PREDICTIONS = (
    Prediction(
        "09.error",
        "in/s²",
        0.162,
        "One expects the difference to be about as good as the readings, or twice as much. But it "
        "is divided by the square of a ninth of a second, and signs that alternate do twice as "
        "much as one bad reading: 4 × 0.0005 × 81.",
    ),
    Prediction(
        "09.finer",
        "in/s²",
        16.2,
        "A finer table is better, so one expects less. But the readings are as bad as before, and "
        "they are now divided by the square of a tenth of the time: a hundred times the error.",
    ),
    Prediction(
        "09.place",
        "place, 1 to 18",
        8,
        "The source calls it strong, and who looks for it finds it. The table has it eighth, with "
        "a fifth of the strongest.",
        is_place=True,
    ),
)
