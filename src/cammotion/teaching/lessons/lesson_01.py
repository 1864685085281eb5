"""Exercises of notebook 01, who moves when."""

from cammotion.machine.kinematics import (
    DEG_PER_TURN,
    SECONDS_PER_HOUR,
    cycle_time,
    indexing_time,
    peak_acceleration,
)
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Slip
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.shown.turns import way_after, work_in_turn
from cammotion.teaching.shown.ways import peak_of_die


def _mill_peak(m: MillAndDie) -> float:
    return float(peak_acceleration(m.pitch_mm, m.mill_angle_deg, m.rate_per_hour))


def _die_peak(m: MillAndDie) -> float:
    return float(peak_acceleration(m.stroke_mm, m.die_angle_deg, m.rate_per_hour))


_NO_WORK = (
    "While the die is down and works it does not move. The degrees of its work are not free either."
)
_ADDED_UP = tuple(
    Slip(
        lambda m, off_deg=off_deg: m.die_angle_deg + off_deg / 2,  # type: ignore[misc]
        "If the way is right, the sum is not: 360 less the mill's degrees, less those of the work. "
        "Add up once more.",
    )
    for off_deg in (10, -10, 20, -20, 100, -100)
)

EXERCISES = (
    NumberExercise(
        number="01.1",
        question=lambda m: (
            f"The mill moves over {m.mill_angle_deg:g} degrees of each turn, and the die stays "
            f"down for {m.work_deg:g} degrees. The two take turns. How many degrees are left for "
            "each way of the die, if down and up get equally many?"
        ),
        unit="deg",
        is_sum=True,
        answer=lambda m: m.die_angle_deg,
        shows=way_after(),
        right=(
            "Mill and work come first, and the die has to do with what is left. This subtraction "
            "decides how hard it will be pushed."
        ),
        slips=(
            Slip(
                lambda m: 2 * m.die_angle_deg,
                "These are the degrees for both ways together. Each of the two gets half of them.",
            ),
            Slip(lambda m: (DEG_PER_TURN - m.mill_angle_deg) / 2, _NO_WORK),
            Slip(
                lambda m: (DEG_PER_TURN - m.work_deg) / 2,
                "The die may not move while the mill does. The mill's degrees have to be taken "
                "away too.",
            ),
            Slip(
                lambda m: DEG_PER_TURN - m.mill_angle_deg - m.work_deg / 2,
                "Here only the work was halved. Put brackets around the whole difference, and "
                "halve that.",
            ),
            Slip(
                lambda m: DEG_PER_TURN - m.mill_angle_deg / 2 - m.work_deg,
                "Here only the mill's degrees were halved. Put brackets around the whole "
                "difference, and halve that.",
            ),
            Slip(
                lambda m: DEG_PER_TURN - (m.mill_angle_deg + m.work_deg) / 2,
                "Here only what mill and work need was halved. Put brackets around the whole "
                "difference, and halve that.",
            ),
            Slip(
                lambda m: m.mill_angle_deg + m.work_deg,
                "These are the degrees of mill and work. What do they leave of a turn, for two "
                "ways?",
            ),
            Slip(
                lambda m: DEG_PER_TURN - m.mill_angle_deg,
                "This is what the mill leaves. The work needs its degrees too, and there are two "
                "ways.",
            ),
            Slip(
                lambda m: DEG_PER_TURN - m.work_deg,
                "This is what the work leaves. The mill needs its degrees too, and there are two "
                "ways.",
            ),
            Slip(
                lambda m: (m.mill_angle_deg + m.work_deg) / 2,
                "This is half of what mill and work need. What do they leave of a turn?",
            ),
            Slip(
                lambda m: m.mill_angle_deg - m.work_deg,
                "The work was taken from the mill's degrees. Both are taken from those of a turn.",
            ),
            Slip(
                lambda m: m.die_angle_deg - m.work_deg / 2,
                "The work was taken away twice. The die works once a turn, between its two ways.",
            ),
            Slip(
                lambda m: m.die_angle_deg + m.work_deg,
                "The work was added. While the die works it does not move: take its degrees away.",
            ),
            *_ADDED_UP,
        ),
        hints=(
            "One turn has 360 degrees. Who needs which part of it?",
            "Take away what the mill needs to move, and what the die needs for its work.",
            "What is left is for two ways of the die, down and up. Share it out equally.",
        ),
    ),
    NumberExercise(
        number="01.2",
        question=lambda m: (
            f"How long does the die stay down for its {m.work_deg:g} degrees of work, in seconds, "
            f"if the machine makes {m.rate_per_hour:g} pieces per hour?"
        ),
        unit="s",
        answer=lambda m: indexing_time(m.work_deg, m.rate_per_hour),
        shows=work_in_turn,
        right=(
            "If the work needs this time, to heat or to glue, then the dwell cannot stay the same "
            "when the machine is to run faster."
        ),
        slips=(
            Slip(
                lambda m: cycle_time(m.rate_per_hour),
                "This is the time of a whole turn. The work takes only a part of it.",
            ),
            Slip(
                lambda m: indexing_time(1, m.rate_per_hour),
                "This is the time of one degree. The work takes many.",
            ),
            Slip(
                lambda m: (
                    indexing_time(m.mill_angle_deg, m.rate_per_hour)
                    + indexing_time(m.work_deg, m.rate_per_hour)
                ),
                "This is the time of mill and work together. How long does the die stay down?",
            ),
            Slip(
                lambda m: m.work_deg * cycle_time(m.rate_per_hour),
                "The time of a turn was multiplied by degrees. It is the part of 360 degrees that "
                "counts.",
            ),
            Slip(
                lambda m: m.work_deg / DEG_PER_TURN * m.rate_per_hour / SECONDS_PER_HOUR,
                "The rate stands upside down: N pieces per hour means that one piece takes 3600/N "
                "seconds.",
            ),
            Slip(
                lambda m: indexing_time(m.die_angle_deg, m.rate_per_hour),
                "This is how long the die moves each way. How long does it stay down?",
            ),
            Slip(
                lambda m: indexing_time(m.mill_angle_deg, m.rate_per_hour),
                "This is how long the mill moves. How long does the die stay down?",
            ),
            Slip(
                lambda m: indexing_time(DEG_PER_TURN - m.work_deg, m.rate_per_hour),
                "This is the rest of the turn, in which the die is not down.",
            ),
            Slip(
                lambda m: indexing_time(2 * m.die_angle_deg, m.rate_per_hour),
                "This is how long the die moves, both ways together. How long does it stay down?",
            ),
            Slip(
                lambda m: indexing_time(DEG_PER_TURN - m.mill_angle_deg, m.rate_per_hour),
                "This is how long the mill stands. Meanwhile the die works, and moves both ways.",
            ),
        ),
        hints=(
            "First the time of a turn: an hour has 3600 seconds, and in it so many turns.",
            "The work takes a part of the turn: its degrees, out of 360.",
            "The work takes the same part of the time as of the angle.",
        ),
    ),
    NumberExercise(
        number="01.3",
        question=lambda m: (
            f"The mill goes {m.pitch_mm:g} mm over {m.mill_angle_deg:g} degrees, the die "
            f"{m.stroke_mm:g} mm over the degrees of exercise 01.1, both by the cycloidal law. "
            "Divide the peak acceleration of the die by that of the mill. What do you get?"
        ),
        unit="",
        is_quotient=True,
        answer=lambda m: m.stroke_mm / m.pitch_mm * (m.mill_angle_deg / m.die_angle_deg) ** 2,
        goes_on_from={
            "01.1": lambda m, degrees: m.stroke_mm / m.pitch_mm * (m.mill_angle_deg / degrees) ** 2
        },
        shows=peak_of_die("With this ratio", peak=lambda m, ratio: ratio * _mill_peak(m)),
        right=(
            "The angle counts twice and the stroke once. That is why a short way can be the harder "
            "one."
        ),
        slips=(
            Slip(
                lambda m: m.stroke_mm / m.pitch_mm * m.mill_angle_deg / m.die_angle_deg,
                "This is the ratio of the velocities. For an acceleration the time counts twice: "
                "the ratio of the angles has to be squared.",
            ),
            Slip(
                lambda m: (m.mill_angle_deg / m.die_angle_deg) ** 2,
                "The angles are right, but the two do not go equally far. Where are the strokes?",
            ),
            Slip(
                lambda m: m.pitch_mm / m.stroke_mm * (m.die_angle_deg / m.mill_angle_deg) ** 2,
                "This is the mill's peak divided by the die's. Turn it over.",
            ),
            Slip(
                lambda m: m.stroke_mm / m.pitch_mm * (m.die_angle_deg / m.mill_angle_deg) ** 2,
                "The angles stand upside down: a longer angle makes the acceleration smaller.",
            ),
            Slip(
                lambda m: m.stroke_mm / m.pitch_mm * (m.mill_angle_deg / m.die_angle_deg / 2) ** 2,
                "This is with twice the angle of the die. The degrees of 01.1 are for one way.",
            ),
            Slip(
                lambda m: m.stroke_mm / m.pitch_mm * (m.mill_angle_deg / m.work_deg) ** 2,
                "This is with the degrees of the work, in which the die does not move.",
            ),
            Slip(
                lambda m: m.stroke_mm / m.pitch_mm,
                "This is the ratio of the strokes alone. The two also have different angles.",
            ),
            Slip(
                lambda m: m.pitch_mm / m.stroke_mm,
                "This is the ratio of the strokes alone, and upside down: the mill's by the die's. "
                "The two also have different angles.",
            ),
            Slip(
                lambda m: m.mill_angle_deg / m.die_angle_deg,
                "This is the ratio of the angles alone. It has to be squared, and the two do not "
                "go equally far.",
            ),
            Slip(
                lambda m: m.pitch_mm / m.stroke_mm * m.die_angle_deg / m.mill_angle_deg,
                "This is the ratio of the velocities, the mill's divided by the die's. Turn it "
                "over, and square the ratio of the angles.",
            ),
            Slip(
                lambda m: m.pitch_mm / m.stroke_mm * (m.mill_angle_deg / m.die_angle_deg) ** 2,
                "The strokes stand upside down: a longer stroke makes the acceleration larger.",
            ),
            Slip(
                lambda m: (m.stroke_mm / m.pitch_mm * m.mill_angle_deg / m.die_angle_deg) ** 2,
                "The strokes were squared too. Only the angles are: the stroke counts once.",
            ),
            Slip(
                lambda m: m.stroke_mm / m.pitch_mm * (m.mill_angle_deg / m.die_angle_deg) ** 3,
                "This is the ratio of the jerks. For an acceleration the angles are squared.",
            ),
            Slip(
                lambda m: _die_peak(m) / _mill_peak(m) - 1,
                "By this share the die's peak is larger than the mill's. Their ratio is asked for.",
            ),
            Slip(_die_peak, "This is the die's peak itself. Divide it by that of the mill."),
            Slip(_mill_peak, "This is the mill's peak itself. Divide the die's by it."),
            Slip(
                lambda m: (
                    m.stroke_mm
                    / m.pitch_mm
                    * (m.mill_angle_deg / ((DEG_PER_TURN - m.mill_angle_deg) / 2)) ** 2
                ),
                f"This is with another angle of the die. {_NO_WORK}",
            ),
        ),
        hints=(
            "The peak acceleration goes with the stroke, and with 1 over the square of the angle.",
            "In the ratio of the two everything that they share cancels: the rate and the law.",
            "It is the ratio of the strokes, times the square of the ratio of the angles, the "
            "right way up.",
        ),
    ),
    ChoiceExercise(
        number="01.4",
        question=lambda m: (
            "In the timing diagram of a machine the curves of two mechanisms cross at 200 degrees. "
            "What follows?"
        ),
        options={
            "a": "They collide at 200 degrees.",
            "b": "At 200 degrees both are equally many millimetres from their zero.",
            "c": "At 200 degrees both are equally fast.",
            "d": "One of them has to be moved in the diagram until the curves keep apart.",
        },
        answer="b",
        reasons={
            "a": (
                "A timing diagram says when, not where. The two may move in different directions, "
                "metres apart."
            ),
            "c": "How fast they are shows in the slope of the curves, not in their height.",
            "d": (
                "Curves may cross as they like. Whether two parts are in each other's way depends "
                "on where they are in the machine."
            ),
        },
        right=(
            "Equal heights mean equal displacements in mm, and nothing else. Whether two parts "
            "collide has to be asked of the machine, not of its diagram."
        ),
        hints=(
            "What is drawn vertically in a timing diagram?",
            "Think of the mill, which moves sideways, and the die, which moves up and down.",
            "Two options speak of places in the machine, one of velocity. Does the diagram show "
            "those in the height of a curve?",
        ),
    ),
)

PREDICTIONS = (
    Prediction(
        "01.half",
        "degrees for each way",
        92.5,
        "A likely guess is twice as many, 110, and another 130: 55 and the 75 that the mill "
        "gives up. But the work keeps its 100, and the 75 have to serve two ways.",
    ),
    Prediction(
        "01.harder",
        "mill or die, and how many times",
        "the die, 3.72 times",
        "It is tempting to name the mill, because it goes further, or to say 1.4 times, which is "
        "the ratio of the velocities.",
    ),
    Prediction(
        "01.rate",
        "factors of displacement, velocity, acceleration",
        "1, 2 and 4",
        "The stroke is cut into the cam: a faster turn makes it shorter in time, not longer in "
        "millimetres. And who only doubles the acceleration has counted the time once: it counts "
        "once for each derivative.",
    ),
)
