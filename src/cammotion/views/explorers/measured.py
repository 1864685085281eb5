"""The explorer of a measured cam: reading errors, smoothing and harmonics, and its acceleration.

All of it is closed: the table is a sum of harmonics, and so are the reading errors; the smoothing
spline divides each by a number of its own, and its second derivative is straight between points.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import sympy as sp

from cammotion.arguments import checked
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M, RATE, cycle_time
from cammotion.measured.cam_table import CamTable
from cammotion.measured.differences import differences
from cammotion.measured.harmonics import check_even_cycle
from cammotion.measured.inch import MM_PER_INCH
from cammotion.measured.smoother import EvenCycle
from cammotion.quantities import Floats, InputError, one_of
from cammotion.views.live.explore import explore
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.parts import Control, Line, Panel, Say, choice
from cammotion.views.measured_plots import METRES

ERROR, EXPONENT, HARMONICS = sp.symbols("e q n", real=True)
_ANGLE = sp.Symbol("theta", real=True)
_MOST = 72  # points: each is a wave in every formula
_STEPS = 20  # so many errors of half a digit is the largest on the slider
_USUAL_MM = 0.01
_TICK_DEG = 45
_NOTHING = 1e-12


@checked
def explore_measured(table: CamTable, rate_per_hour: float, *, unit: str = "m") -> LiveFigure:
    """Return a live figure of a cam's acceleration: with reading errors, smoothed, few harmonics.

    `table` is a whole turn with an even number of even angles, at most 72; `rate_per_hour` counts
    the turns of its camshaft in an hour. The curve is the acceleration of the smoothing spline, the
    dashed line that of the table's second differences; below is how far the curve is from each
    reading. The controls are the reading error in mm, the exponent of 10 of the amount in rad^4 as
    `smoothed` takes it, and the number of harmonics that are kept; a choice says which readings
    are off. With `unit` "in" lengths are in inches, with SI beside them. Raises InputError for
    another table, rate or unit.

    >>> angles = np.arange(0, 360, 10)
    >>> cam = CamTable(angles, 25 - 25 * np.cos(np.radians(angles)), 0.01, is_cycle=True)
    >>> figure = explore_measured(cam, 900)
    >>> figure.values = {ERROR: 0.1}
    >>> print(figure.text)
    at 180°: −0.159 m/s²
    random errors up to this size: ±0.028 m/s², root mean square
    """
    number = _checked(table)
    unit = one_of("unit of length", unit, METRES)
    is_inch = unit == "in"
    small, mm = ("in", MM_PER_INCH) if is_inch else ("mm", 1.0)
    turn = float(cycle_time(RATE.number(rate_per_hour)))
    scale = (2 * np.pi / turn) ** 2 * (1 if is_inch else mm / MM_PER_M)  # of small/rad2
    smoother, half = EvenCycle(number), number // 2 + 1
    kept = [
        sp.Heaviside(HARMONICS - rank + 0.5) / (1 + 10**EXPONENT * float(mu))
        for rank, mu in enumerate(smoother.eigenvalues[:half])
    ]
    bends = [float(bend) * scale * part for bend, part in zip(smoother.bends, kept, strict=False)]
    chords = -((number / np.pi * np.sin(np.pi * np.arange(half) / number)) ** 2) * scale
    waves = [(sp.Integer(1), _waves(table.position_mm / mm)), *_errors(number)]
    lowest = int(np.argmin(differences(table, 1.0).acceleration))
    low = _sum(waves, bends, sp.Integer(lowest))
    twice = [*[2] * (half - 1), 1]  # but for the last rank, k and -k are two
    squares = sp.Add(*(two * bend**2 for two, bend in zip(twice, bends, strict=True)))
    missed = [1000 * (part - 1) for part in kept]
    finest = table.step_mm / 2 or _USUAL_MM
    return explore(
        [
            Panel(
                lines=[
                    Line(y=_joined(waves[:1], [*chords], number), role="reference"),
                    Line(y=_joined(waves, bends, number), colour=0),
                ],
                y=f"acceleration in {unit}/s²",
                x="cam angle in deg",
                x_ticks=_TICK_DEG,
                height=150,
            ),
            Panel(
                lines=[Line(y=_joined(waves, missed, number), colour=1)],
                y=f"difference in {'0.001 in' if is_inch else 'µm'}",
                x="cam angle in deg",
                x_ticks=_TICK_DEG,
            ),
        ],
        (_ANGLE, 0, DEG_PER_TURN),
        {
            ERROR: Control(
                low=0,
                high=_STEPS * finest / mm,
                step=finest / mm,
                start=finest / mm,
                name="reading error",
                unit=small,
            ),
            EXPONENT: Control(
                low=-7, high=-2, step=0.05, start=-7, name="smoothing, exponent", unit=""
            ),
            HARMONICS: Control(
                low=1, high=half - 1, step=1, start=half - 1, name="harmonics", unit=""
            ),
        },
        says=[
            Say(
                f"at {table.angle_deg[lowest]:g}°: "
                + ("{low:.1f} in/s² = {si:.3f} m/s²" if is_inch else "{low:.3f} m/s²"),
                {"low": low, "si": low * METRES[unit]} if is_inch else {"low": low},
            ),
            Say(
                f"random errors up to this size: ±{{by:.{2 if is_inch else 3}f}} {unit}/s², "
                "root mean square",
                {"by": ERROR / sp.sqrt(3) * sp.sqrt(squares / number)},
            ),
        ],
        title="A measured cam",
    )


def _checked(table: CamTable) -> int:
    """Return the number of points of a table that can be drawn."""
    check_even_cycle(table, "the harmonics of the figure")
    number = table.angle_deg.size
    if number % 2 or number > _MOST or abs(table.angle_deg[0]) > _NOTHING:
        raise InputError(
            f"The table has {number} points from {table.angle_deg[0]:g} deg on; the figure draws "
            f"an even number of {_MOST} at most, from 0 deg on: take every second point, or turn "
            "the angles."
        )
    return number


def _waves(values: Floats) -> list[tuple[int, float, float]]:
    """Return rank, amplitude and phase in rad of the harmonics of an even number of values."""
    found = np.fft.rfft(values) / (values.size / 2)
    found[-1] /= 2
    least = _NOTHING * np.abs(found).max()
    return [
        (rank, float(abs(one)), -float(np.angle(one)))
        for rank, one in enumerate(found)
        if rank and abs(one) > least
    ]


def _errors(number: int) -> list[tuple[Any, list[tuple[int, float, float]]]]:
    """Return the errors that can be chosen: how large they are, and the harmonics of a unit."""
    quarter = number // 4
    alternating, single = choice(
        "errors",
        {
            "alternate": (ERROR, sp.Integer(0)),
            f"one, at {quarter * DEG_PER_TURN / number:g}°": (sp.Integer(0), ERROR),
            "all alike": (sp.Integer(0), sp.Integer(0)),
        },
    )
    places = np.arange(number)
    zigzag = np.where(places % 2, -1.0, 1.0)
    return [(alternating, _waves(zigzag)), (single, _waves(np.where(places == quarter, 1.0, 0.0)))]


def _sum(waves: Sequence[Any], factors: Sequence[Any], point: sp.Expr) -> sp.Expr:
    """Return the sum of all harmonics at the number of a point, each rank times its factor."""
    number = 2 * (len(factors) - 1)
    return sp.Add(
        *(
            size * factors[rank] * amplitude * sp.cos(2 * sp.pi * rank * point / number - phase)
            for size, each in waves
            for rank, amplitude, phase in each
        )
    )


def _joined(waves: Sequence[Any], factors: Sequence[Any], number: int) -> sp.Expr:
    """Return it over the cam angle, in straight lines from point to point."""
    place = _ANGLE * number / DEG_PER_TURN
    part = sp.frac(place)
    before, after = (_sum(waves, factors, sp.floor(place) + one) for one in (0, 1))
    return (1 - part) * before + part * after
