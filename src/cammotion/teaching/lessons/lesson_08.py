"""Exercises of notebook 08, sizing the indexer."""

import math
from collections.abc import Callable, Iterator
from functools import partial

from cammotion.hardware.geneva import Geneva
from cammotion.hardware.indexer import Indexer
from cammotion.laws.catalogue import LAWS
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M, SECONDS_PER_MINUTE
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Slip
from cammotion.teaching.lessons.lesson_05 import SPOKEN_LAWS
from cammotion.teaching.number_exercise import OF_THE_LESSON, NumberExercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.shown.bars import step_of_torque

_SQUARE = 4  # slots, at right angles
_RIGHT_ANGLE = 90  # deg
_G = 9.81  # as in the source
_LESSONS = Indexer(38.5, 8, 0.75, law="modified sine", friction_N_m=10)  # the table of the lesson
_LESSONS_DEG = 150  # the angle of its camshaft
_OTHER_LAWS = {
    **SPOKEN_LAWS,
    "modified sine": "modified sine, the law of the lesson's table",
}


def _m2(length_mm: float) -> float:
    """Return the square of a length, in m2."""
    return (length_mm / MM_PER_M) ** 2


def _plate(m: MillAndDie) -> float:
    """Return the inertia of the plate, in kg m2: that of a ring."""
    return m.table.plate_kg * (_m2(m.table.plate_mm) + _m2(m.table.hole_mm)) / 2


def _full_plate(m: MillAndDie) -> float:
    """Return it as if it had no hole."""
    return m.table.plate_kg * _m2(m.table.plate_mm) / 2


def _weight(m: MillAndDie) -> float:
    """Return the mass of all stations, in kg."""
    return m.table.stops * m.table.station_kg


def _stations(m: MillAndDie) -> float:
    return _weight(m) * _m2(m.table.radius_mm)


def _inertia(m: MillAndDie) -> float:
    return _plate(m) + _stations(m)


def _step(m: MillAndDie) -> float:
    """Return the angle of an index, in rad."""
    return 2 * math.pi / m.table.stops


def _alpha(m: MillAndDie, factor: float | None = None) -> float:
    """Return the peak of the angular acceleration in rad/s2, with another law's factor if given."""
    return (LAWS[m.table.law].Ca if factor is None else factor) * _step(m) / m.table.time_s**2


def _inertia_torque(m: MillAndDie, inertia: float | None = None) -> float:
    return (_inertia(m) if inertia is None else inertia) * _alpha(m)


def _torque(m: MillAndDie) -> float:
    return _inertia_torque(m) + m.table.friction_N_m


def _other_on_table(m: MillAndDie, law: str) -> float:
    """Return what Ca of another law leads to; NaN where the question is about that law."""
    torque = _inertia(m) * _alpha(m, LAWS[law].Ca) + m.table.friction_N_m
    return math.nan if m.table.law == law else torque


def _other_on_shaft(m: MillAndDie, law: str) -> float:
    """Return what Cq of another law leads to; NaN where the question is about that law."""
    return math.nan if m.table.law == law else _shaft(m, factor=LAWS[law].Cq)


def _of_other_laws(torque: Callable[..., float]) -> Iterator[Slip]:
    """Yield a slip for each law that may be taken in place of that of the question."""
    for law, said in _OTHER_LAWS.items():
        reason = f"This is the {said}. The question names another law."
        yield Slip(partial(torque, law=law), reason)


def _ratio(m: MillAndDie) -> float:
    """Return by how much the table turns for each radian of the camshaft, in the mean."""
    return _step(m) / math.radians(m.table.angle_deg)


def _shaft(m: MillAndDie, inertia: float | None = None, factor: float | None = None) -> float:
    """Return the peak of the camshaft's torque; the factor is Cq unless given."""
    turns = _inertia(m) if inertia is None else inertia
    cq = LAWS[m.table.law].Cq if factor is None else factor
    return turns * _step(m) / m.table.time_s**2 * cq * _ratio(m)


def _indexer(m: MillAndDie) -> Indexer:
    """Return the table with its friction."""
    t = m.table
    return Indexer(_inertia(m), t.stops, t.time_s, law=t.law, friction_N_m=t.friction_N_m)


def _wheel(m: MillAndDie) -> Geneva:
    return Geneva(m.table.slots)


def _omega(m: MillAndDie) -> float:
    """Return how fast the driver of the wheel turns, in rad/s."""
    return m.table.per_minute * 2 * math.pi / SECONDS_PER_MINUTE


def _half_way(m: MillAndDie, derivative: int = 2) -> float:
    """Return a derivative by alpha, half-way between entry and middle."""
    return abs(float(_wheel(m)(_wheel(m).angle_deg / 4, derivative)))


def _at(m: MillAndDie, alpha_deg: float) -> float:
    """Return the wheel's angular acceleration where the driver is so far from the middle."""
    return abs(float(_wheel(m)(alpha_deg, 2))) * _omega(m) ** 2


def _half_of_the_wheels_way(m: MillAndDie) -> float:
    """Return the acceleration where the wheel is half-way from the pin's entry to the middle.

    The distance of the two axes is to the crank as the sine of alpha + beta is to that of beta.
    """
    beta = math.pi / m.table.slots / 2
    return _at(m, math.degrees(math.asin(math.sin(beta) / _wheel(m).ratio) - beta))


def _without_arctan(m: MillAndDie) -> float:
    """Return what the tangent of the wheel's angle, differentiated twice, makes half-way."""
    k, alpha = _wheel(m).ratio, math.radians(_wheel(m).angle_deg / 4)
    under = 1 - k * math.cos(alpha)
    bent = k * math.sin(alpha) * (2 * k**2 - 1 - k * math.cos(alpha)) / under**3
    return abs(bent) * _omega(m) ** 2


def _by_the_formula(m: MillAndDie, ratio: float, alpha: float) -> float:
    """Return the acceleration for another lambda, or another alpha in rad."""
    under = 1 - 2 * ratio * math.cos(alpha) + ratio**2
    return abs(ratio * (1 - ratio**2) * math.sin(alpha) / under**2) * _omega(m) ** 2


def _degrees_for_rad(m: MillAndDie, *, in_lambda: bool, in_alpha: bool) -> float:
    """Return the acceleration if pi/n, alpha or both were put in in deg as if in rad."""
    ratio = math.sin(DEG_PER_TURN / 2 / m.table.slots) if in_lambda else _wheel(m).ratio
    alpha = _wheel(m).angle_deg / 4
    return _by_the_formula(m, ratio, alpha if in_alpha else math.radians(alpha))


def _of_two_pi(m: MillAndDie) -> float:
    """Return the acceleration with lambda = sin(2 pi/n), NaN where that is 1."""
    ratio = math.sin(2 * math.pi / m.table.slots)
    alpha = math.radians(_wheel(m).angle_deg / 4)
    return _by_the_formula(m, ratio, alpha) if m.table.slots != _SQUARE else math.nan


def _of_cosine(m: MillAndDie) -> float:
    """Return the acceleration with lambda = cos(pi/n), NaN where that is the sine."""
    ratio = math.cos(math.pi / m.table.slots)
    alpha = math.radians(_wheel(m).angle_deg / 4)
    return _by_the_formula(m, ratio, alpha) if m.table.slots != _SQUARE else math.nan


def _plate_in_words(m: MillAndDie) -> str:
    t = m.table
    hole = f", weighed with its hole of radius {t.hole_mm:g} mm in the middle" if t.hole_mm else ""
    return f"a round plate of {t.plate_kg:g} kg and of radius {t.plate_mm:g} mm{hole}"


EXERCISES = (
    NumberExercise(
        number="08.1",
        question=lambda m: (
            f"Your table is {_plate_in_words(m)}. It carries {m.table.stops} stations of "
            f"{m.table.station_kg:g} kg each, small enough to be points, "
            f"{m.table.radius_mm:g} mm from the axis. What is its moment of inertia?"
        ),
        unit="kg m²",
        answer=_inertia,
        right="Each mass counts by the square of its radius: what lies far out counts most.",
        slips=(
            Slip(
                lambda m: _inertia(m) / 4,
                "This is a quarter: all radii were halved, as if they were diameters.",
            ),
            Slip(
                lambda m: _plate(m) + _stations(m) / 4,
                "The radius of the stations was halved, as if it were a diameter. The source's "
                "print does so too.",
            ),
            Slip(
                lambda m: 4 * _inertia(m),
                "This is four times the moment of inertia: GD², or diameters in the place of "
                "radii.",
            ),
            Slip(
                lambda m: 4 * _G * _inertia(m),
                "This is GD² = 4 g I, in N m². The moment of inertia I is asked for.",
            ),
            Slip(
                lambda m: (
                    m.table.plate_kg * (_m2(m.table.plate_mm) - _m2(m.table.hole_mm)) / 2
                    + _stations(m)
                ),
                "The square of the hole was taken away. Its mass is gone already: what is left "
                "lies farther out, so that the squares add up.",
            ),
            Slip(
                lambda m: (
                    _full_plate(m) * (1 - (m.table.hole_mm / m.table.plate_mm) ** 4) + _stations(m)
                ),
                "The mass was weighed with the hole, and here the hole is taken away once more. "
                "What is the density, if the ring has all of this mass?",
            ),
            Slip(
                lambda m: (
                    _full_plate(m) / (1 - (m.table.hole_mm / m.table.plate_mm) ** 2) + _stations(m)
                ),
                "The density is right, but the integral begins at the axis. It begins at the hole.",
            ),
            Slip(
                lambda m: (
                    _plate(m) - 3 / 8 * m.table.plate_kg * _m2(m.table.hole_mm) + _stations(m)
                ),
                "The radius of the hole was halved, as if it were a diameter.",
            ),
            Slip(
                lambda m: _full_plate(m) + _stations(m),
                "Here the plate has no hole. With the same mass and a hole more of it lies "
                "outside.",
            ),
            Slip(
                lambda m: 2 * _plate(m) + _stations(m),
                "The half of the plate is missing: its mass lies between the axis and the rim, "
                "and not all at the rim.",
            ),
            Slip(
                lambda m: 2 * _full_plate(m) + _stations(m),
                "Here all of the plate is at its rim. Its mass lies between the hole and the rim.",
            ),
            Slip(
                lambda m: _plate(m) / 2 + _stations(m),
                "The plate counts with a quarter here, as about a diameter. About its axis it is a "
                "half.",
            ),
            Slip(
                lambda m: _plate(m) / 4 + _stations(m),
                "The radii of the plate were halved, as if they were diameters.",
            ),
            Slip(
                lambda m: _plate(m) + _stations(m) / 2,
                "The stations were halved like a plate. All of a station is at its radius.",
            ),
            Slip(
                lambda m: _plate(m) + _stations(m) / m.table.stops,
                "This is with one station. How many does the table carry?",
            ),
            Slip(_plate, "This is the plate alone. The stations turn too."),
            Slip(_stations, "These are the stations alone. The plate turns too."),
            Slip(
                lambda m: _plate(m) + _weight(m) * _m2(m.table.plate_mm),
                "Here the stations are at the rim. How far are they from the axis?",
            ),
            Slip(
                lambda m: (
                    m.table.plate_kg * (m.table.plate_mm + m.table.hole_mm) / MM_PER_M / 2
                    + _weight(m) * m.table.radius_mm / MM_PER_M
                ),
                "The radius counts twice, as a square: once for the lever, once for the way.",
            ),
            Slip(
                lambda m: (m.table.plate_kg + _weight(m)) * _m2(m.table.radius_mm),
                "Here all of the mass is where the stations are. The plate's is not.",
            ),
            Slip(lambda _: _LESSONS.inertia_kg_m2, OF_THE_LESSON),
            Slip(
                lambda m: m.table.plate_kg + _weight(m),
                "This is the mass, in kg. Each part of it counts by the square of its radius.",
            ),
        ),
        hints=(
            "Each part alone first, then add up. Lengths in metres.",
            "For the plate do the integral of the lesson from the hole to the rim. What is then "
            "the density, if the mass is the one given?",
            "The difference of the fourth powers divided by that of the squares is a sum of "
            "squares. The stations count with n m r².",
        ),
    ),
    NumberExercise(
        number="08.2",
        question=lambda m: (
            f"The table of exercise 08.1 makes an index, from one of its {m.table.stops} stations "
            f"to the next, in {m.table.time_s:g} s by the law '{m.table.law}'. Friction takes "
            f"{m.table.friction_N_m:g} N m. What is the largest torque?"
        ),
        unit="N m",
        answer=_torque,
        goes_on_from={
            "08.1": lambda m, inertia: _inertia_torque(m, inertia) + m.table.friction_N_m
        },
        shows=step_of_torque(
            step_deg=lambda m: DEG_PER_TURN / m.table.stops,
            needed=_inertia_torque,
            drag=lambda m: m.table.friction_N_m,
        ),
        right="This is what shaft, key and gear have to bear, before any safety factor.",
        slips=(
            Slip(
                _inertia_torque,
                "This is the inertia alone. Friction has to be overcome as well.",
            ),
            Slip(
                lambda m: _inertia_torque(m) - m.table.friction_N_m,
                "Friction was subtracted. It helps to stop the table, but not to set it going.",
            ),
            Slip(
                lambda m: _torque(m) + m.table.friction_N_m,
                "Friction was added twice. It acts against the table once.",
            ),
            Slip(
                lambda m: math.degrees(_inertia_torque(m)) + m.table.friction_N_m,
                "The step is in degrees here. A torque comes from rad/s².",
            ),
            Slip(
                lambda m: _inertia_torque(m) * m.table.stops + m.table.friction_N_m,
                "Here the table makes a whole turn in that time, and not one step.",
            ),
            Slip(
                lambda m: _inertia_torque(m) / (2 * math.pi) + m.table.friction_N_m,
                "The step is a part of a turn here. A turn is 2 pi radians.",
            ),
            Slip(
                lambda m: _inertia_torque(m) / 2 + m.table.friction_N_m,
                "The inertia counts by half here. A turn is 2 pi, not pi, and a half in I has its "
                "place in the plate alone.",
            ),
            Slip(
                lambda m: _inertia_torque(m) * m.table.time_s + m.table.friction_N_m,
                "The time counts twice, as a square.",
            ),
            Slip(
                lambda m: _inertia(m) * _alpha(m, LAWS[m.table.law].Cv) + m.table.friction_N_m,
                "This is with the velocity factor Cv. An acceleration has the factor Ca.",
            ),
            Slip(
                lambda m: _inertia(m) * _alpha(m, 1) + m.table.friction_N_m,
                "The factor Ca of the law is missing.",
            ),
            Slip(
                lambda m: _inertia(m) * _alpha(m, 4) + m.table.friction_N_m,
                "This is with a factor of 4, the constant acceleration's. This law has a larger "
                "one.",
            ),
            *_of_other_laws(_other_on_table),
            Slip(
                lambda m: _inertia(m) * _alpha(m, LAWS[m.table.law].Cq) + m.table.friction_N_m,
                "This is with Cq, the largest V A, which belongs to the power. The torque has Ca.",
            ),
            Slip(lambda _: _LESSONS.required_torque_N_m, OF_THE_LESSON),
            Slip(_alpha, "This is the angular acceleration, in rad/s². Which inertia is there?"),
            Slip(
                lambda m: _inertia_torque(m) / m.table.radius_mm * MM_PER_M,
                "This is a force, in N, at the stations. The torque about the axis is asked for.",
            ),
            Slip(
                lambda m: _torque(m) * 4 * _G,
                "This is with GD² in the place of the moment of inertia, 4 g times too large.",
            ),
        ),
        hints=(
            "How large is one step, in radians?",
            "The largest angular acceleration is Ca times the step over the square of the time; "
            "cm.LAWS knows Ca.",
            "Times the moment of inertia, in kg m², it is the torque of the inertia. Friction is "
            "added.",
        ),
    ),
    NumberExercise(
        number="08.3",
        question=lambda m: (
            "A camshaft drives the table of exercise 08.2 by a cam, in the same time and by the "
            "same law, without losses. During the index it turns evenly by "
            f"{m.table.angle_deg:g} degrees. Leave friction out: how large is the largest torque "
            "that the inertia asks of the camshaft?"
        ),
        unit="N m",
        answer=_shaft,
        goes_on_from={"08.1": lambda m, inertia: _shaft(m, inertia)},
        right="With a longer angle in the same index time it gets less, and the torque on the "
        "table does not change.",
        slips=(
            Slip(
                lambda m: _shaft(m, factor=LAWS[m.table.law].Ca * LAWS[m.table.law].Cv),
                "This is the largest V times the largest A. They are not there at the same moment: "
                "the largest product is Cq.",
            ),
            Slip(
                lambda m: _shaft(m, factor=LAWS[m.table.law].Ca),
                "This takes the ratio of the angles, as if the table turned evenly too. Where the "
                "table is fast the shaft has to give more.",
            ),
            Slip(
                _inertia_torque,
                "This is the torque on the table. The shaft has the same power, at another speed.",
            ),
            Slip(
                lambda m: _shaft(m) * math.radians(m.table.angle_deg) / m.table.time_s,
                "This is the power, in W. Divide it by the speed of the shaft.",
            ),
            Slip(
                lambda m: _shaft(m) / m.table.time_s,
                "The power was divided by the angle of the shaft. Its speed is that angle over tm.",
            ),
            Slip(
                lambda m: _indexer(m).peak_camshaft_torque_N_m(m.table.angle_deg),
                "This is with the friction, which the question leaves out.",
            ),
            Slip(
                lambda m: _shaft(m, factor=LAWS[m.table.law].Ca) + m.table.friction_N_m * _ratio(m),
                "This takes the ratio of the angles, as if the table turned evenly too, and the "
                "friction, which the question leaves out.",
            ),
            Slip(
                lambda m: _shaft(m) + m.table.friction_N_m * _ratio(m),
                "Friction is in it, which the question leaves out.",
            ),
            Slip(
                lambda m: _shaft(m) + m.table.friction_N_m * _ratio(m) * LAWS[m.table.law].Cv,
                "Friction is in it, at the largest speed of the table. The question leaves it out.",
            ),
            Slip(
                _torque,
                "This is the torque on the table, with the friction. The question leaves that out, "
                "and the shaft has the same power at another speed.",
            ),
            Slip(
                lambda m: _shaft(m) * m.table.time_s,
                "In the power the time counts three times: twice in the acceleration, once in the "
                "velocity.",
            ),
            Slip(
                lambda m: _shaft(m) / 2,
                "The step is half of what it should be in one place: it is 2 pi/n.",
            ),
            Slip(
                lambda m: _shaft(m) / 4,
                "The step is half of what it should be, and it counts twice. It is 2 pi/n, not "
                "pi/n.",
            ),
            Slip(
                lambda m: _shaft(m) * math.pi / 180,
                "The angle of the shaft is in degrees here. The torque comes from rad/s.",
            ),
            Slip(
                lambda m: _shaft(m) * m.table.angle_deg / DEG_PER_TURN,
                "Here the shaft makes a whole turn during the index.",
            ),
            Slip(
                lambda m: _shaft(m) / _ratio(m),
                "The power's factor Cq is here, but not how much slower or faster the shaft turns "
                "than the table.",
            ),
            Slip(
                lambda m: _inertia_torque(m) / _ratio(m),
                "The ratio of the angles is upside down, and the table turns evenly here. Which of "
                "the two turns faster?",
            ),
            Slip(
                lambda m: _shaft(m) / _ratio(m) ** 2,
                "The ratio of the angles is upside down.",
            ),
            Slip(
                lambda m: _shaft(m, factor=LAWS[m.table.law].Cv),
                "This is with Cv, the largest velocity. The power has Cq, the largest V A.",
            ),
            *_of_other_laws(_other_on_shaft),
            Slip(
                lambda m: _shaft(m) + m.table.friction_N_m,
                "The friction on the table was added. The question leaves it out.",
            ),
            Slip(
                lambda _: _LESSONS.peak_camshaft_torque_N_m(_LESSONS_DEG),
                "This is what the lesson's table asks, with its friction. Yours has other numbers, "
                "and the question leaves friction out.",
            ),
        ),
        hints=(
            "What the shaft gives, the table takes: the power is the same at each moment.",
            "The power of the table is I hm²/tm³ times V A. The largest V A of a law is its Cq.",
            "The shaft turns with its angle, in radians, over tm. Divide the power by it.",
        ),
    ),
    NumberExercise(
        number="08.4",
        question=lambda m: (
            f"The driver of a Geneva wheel with {m.table.slots} slots turns evenly, "
            f"{m.table.per_minute:g} times a minute. How large is the angular acceleration of "
            "the wheel half-way, in the angle of the driver, from the pin's entry to the middle?"
        ),
        unit="rad/s²",
        answer=lambda m: _half_way(m) * _omega(m) ** 2,
        right="Nobody has chosen it: with the slots the whole curve is given.",
        slips=(
            Slip(
                lambda m: _wheel(m).entry_acceleration * _omega(m) ** 2,
                "This is at the entry of the pin. Half-way to the middle is asked for.",
            ),
            Slip(
                lambda m: _wheel(m).peak_acceleration * _omega(m) ** 2,
                "This is the largest one. Half-way from the entry to the middle is elsewhere.",
            ),
            Slip(
                lambda m: _wheel(m).peak_acceleration * _omega(m) ** 2 / 2,
                "This is half of the largest one. The angle is to be halved, not the acceleration.",
            ),
            Slip(
                lambda m: _wheel(m).entry_acceleration * _omega(m) ** 2 / 2,
                "This is half of that at the entry, as if it fell along a straight line.",
            ),
            Slip(
                lambda m: _half_way(m, 1) * _omega(m),
                "This is the velocity, in rad/s. Differentiate once more.",
            ),
            Slip(
                lambda m: _half_way(m) * _omega(m),
                "The speed of the driver counts twice, as a square.",
            ),
            Slip(
                lambda m: _half_way(m) * m.table.per_minute**2,
                "Turns a minute were taken for rad/s.",
            ),
            Slip(
                lambda m: _half_way(m) * (m.table.per_minute / SECONDS_PER_MINUTE) ** 2,
                "Turns a second were taken for rad/s: a turn is 2 pi.",
            ),
            Slip(
                lambda m: _half_way(m) * (m.table.per_minute * 2 * math.pi) ** 2,
                "This is per minute squared. Divide by 60, twice.",
            ),
            Slip(
                lambda m: _half_way(m) * math.degrees(_omega(m)) ** 2,
                "The driver's speed is in degrees a second here. rad/s² come of rad/s.",
            ),
            *(
                Slip(
                    partial(_degrees_for_rad, in_lambda=in_lambda, in_alpha=in_alpha),
                    "An angle in degrees was put into sine and cosine, which take radians.",
                )
                for in_lambda, in_alpha in ((False, True), (True, False), (True, True))
            ),
            Slip(
                _half_way,
                "This is the second derivative by the angle. The square of the driver's speed is "
                "missing.",
            ),
            Slip(
                lambda m: _half_way(m, 1) * _omega(m) ** 2,
                "This is the first derivative with the square of the driver's speed. An "
                "acceleration has the second.",
            ),
            Slip(
                lambda m: _at(m, DEG_PER_TURN / 2 / m.table.slots),
                "Here alpha is pi/n, an angle of the wheel. The driver's, from entry to middle, is "
                "pi/2 - pi/n.",
            ),
            Slip(
                lambda m: _at(m, DEG_PER_TURN / 4 / m.table.slots),
                "Here alpha is pi/(2n), half of an angle of the wheel. The driver's, from entry to "
                "middle, is pi/2 - pi/n.",
            ),
            Slip(
                lambda m: _at(m, _RIGHT_ANGLE / 2),
                "Here alpha is pi/4, and pi/n is forgotten. The driver's, from entry to middle, is "
                "pi/2 - pi/n.",
            ),
            Slip(
                _of_two_pi,
                "Here lambda is sin(2 pi/n). From a slot to the middle between it and the next it "
                "is half as far: sin(pi/n).",
            ),
            Slip(
                _of_cosine,
                "Here lambda is the cosine, which belongs to the radius of the wheel. The crank "
                "has the sine.",
            ),
            Slip(
                _half_of_the_wheels_way,
                "This is half-way in the angle of the wheel. That of the driver is asked for.",
            ),
            Slip(
                _without_arctan,
                "The arctan is missing: its inside was differentiated twice.",
            ),
            Slip(
                lambda m: abs(float(_wheel(m)(_wheel(m).peak_alpha_deg / 2, 2))) * _omega(m) ** 2,
                "This is half-way between the middle and the largest acceleration.",
            ),
            Slip(
                lambda m: _wheel(m).peak_velocity * _omega(m) ** 2,
                "This is the factor of the largest velocity. Is it the second derivative, and "
                "half-way?",
            ),
        ),
        hints=(
            "At which angle does the pin enter, counted from the middle? Half of it is alpha.",
            "Differentiate beta twice by alpha, with lambda = sin(pi/n), and put this alpha in, in "
            "radians.",
            "Times the square of the driver's speed in rad/s it is an acceleration. Its size is "
            "asked for.",
        ),
    ),
    ChoiceExercise(
        number="08.5",
        question=lambda m: (
            "An indexer on a camshaft, whose law and angles stay, is to run twice as fast. "
            "Friction is small. What happens to the largest torque on the table, to the largest "
            "power, and to the largest torque on the camshaft?"
        ),
        options={
            "a": "They become 2, 4 and 2 times as large.",
            "b": "They become 4, 8 and 4 times as large.",
            "c": "They become 4, 8 and 8 times as large.",
            "d": "They become 4, 4 and 4 times as large.",
        },
        answer="b",
        reasons={
            "a": "How often does the time count in an acceleration?",
            "c": "The shaft turns twice as fast too. What does that make of the power, as a "
            "torque?",
            "d": "Power is torque times velocity. Does the velocity stay?",
        },
        right="So without a flywheel a motor that just does it needs eight times the power for "
        "twice the pieces.",
        hints=(
            "How does the time enter into velocity and acceleration?",
            "Power is torque times velocity, on the table and on the shaft alike.",
            "The power of the shaft is its torque times its speed, and that has doubled too.",
        ),
    ),
)

PREDICTIONS = (
    Prediction(
        "08.plate",
        "percent of the inertia",
        13.97,
        "By mass the plate is a fifth. But half of its mass lies within 354 mm, and the stations "
        "are all at 450 mm.",
    ),
    Prediction(
        "08.backlash",
        "times as fast",
        4.64,
        "Ten times is tempting, or the root of ten, as for a fall. But the push of the drive only "
        "begins there, and grows with the time: the gap opens with its third power, and the speed "
        "with its second. So the speed goes with the gap to the power 2/3.",
    ),
    Prediction(
        "08.geneva",
        "times the modified sine's peak",
        0.895,
        "It has a bad name, so most expect a larger peak. With many slots it is a gentle wheel, "
        "but for its ends, where the push is there at once. With six slots or fewer it is larger.",
    ),
)
