"""Cam tables for a PLC or a cam programmer: the position over the cam angle, a file a mechanism."""

import math
from pathlib import Path

import numpy as np

from cammotion.exchange.cam_table_cut import DECIMALS, SEPARATORS
from cammotion.exchange.table_numbers import ANGLE_DECIMALS
from cammotion.files import as_path, check_folder, stems, write_all
from cammotion.machine.diagram import TimingDiagram, as_diagram
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M, into_turn, over_time
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError, Quantity, one_of, shorten

STEP_DEG = Quantity("step of a cam table", "deg", example=1, low=1e-3, high=45, low_included=True)
POINTS = Quantity("number of points of a cam table", "", example=361, low=8, high=400_000)
PLACES = Quantity("number of decimals", "", example=6, high=12, low_included=True)
FORMS = ("plain", "codesys")

_WHOLE = 1e-9  # by such a share a step may miss a whole part of the turn
_NEAR = 0.49  # of the pitch: the middle, and of two alike the stop at which the motion starts
_DIGITS = 14  # behind the first one, which a float has for sure
_FINER = 6  # decimals more, in which a half is known as a half
_INT = 32_767  # points that CODESYS counts in an INT
_ORDERS = {1: "velocity", 2: "acceleration", 3: "jerk"}
_UNITS = {"deg": "mm/deg", "s": "mm/s"}


def write_cam_tables(  # noqa: PLR0913 - what a controller may ask for
    diagram: TimingDiagram,
    folder: str | Path,
    *,
    step_deg: float | None = None,
    points: int | None = None,
    form: str = "plain",
    decimals: int = 6,
    separator: str | None = None,
    decimal: str = ".",
    derivatives: str | None = None,
    overwrite: bool = False,
) -> dict[str, Path]:
    r"""Write a table of each mechanism's motion into a folder; return the paths by the names.

    A table goes from 0 to 360 deg, both included, in even steps of `step_deg` (1 deg if nothing is
    said), which has to divide the turn, or with so many `points`. Its positions in mm have
    `decimals` behind the `decimal` mark, "." or ","; `separator` is "\t", ";", "|", "," or " ".
    With `derivatives` "deg" it lists velocity, acceleration and jerk too, in mm/deg, mm/deg2 and
    mm/deg3, with "s" in mm/s, mm/s2 and mm/s3 at the machine rate, the largest value of each with
    as many digits behind its first one, at least; where two segments meet, as the later one has it.

    The last position is the first; that of an indexing motion is a pitch further, and whole turns
    of the turret are left out so that the first is near the stops that were given. The "plain"
    `form` is a .csv file with a heading, semicolons if nothing is said; `read_cam_table` reads it.
    "codesys" is what CODESYS SoftMotion reads as a cam from an ASCII table: a .txt file of X and Y,
    rising, without a heading, tabs if nothing is said, at most 32,767 points. SoftMotion lays
    polynomials of degree five through them, which may swing if there are many; its own tables have
    128 or 256. The slave's period of an indexing motion is then the pitch.

    Nothing is written over a file that is there, unless `overwrite` is True. Raises InputError
    before anything is written.

    >>> from tempfile import TemporaryDirectory
    >>> import cammotion as cm
    >>> with TemporaryDirectory() as folder:
    ...     paths = write_cam_tables(cm.EXAMPLE.diagram, folder, step_deg=0.1, decimals=4)
    ...     print([path.name for path in paths.values()])
    ...     print(paths["die"].read_text().splitlines()[1800])
    ['mill.csv', 'die.csv']
    179.9;29.3364
    """
    as_diagram(diagram)
    form = one_of("form of a cam table", form, FORMS)
    if derivatives is not None:
        derivatives = one_of("unit of the derivatives", derivatives, _UNITS)
        if form == "codesys":
            raise InputError(
                "CODESYS reads a table of two columns: leave out the derivatives, or write the "
                "plain form."
            )
    separator = (";" if form == "plain" else "\t") if separator is None else separator
    one_of("separator", separator, SEPARATORS)  # which have no case
    if one_of("decimal mark", decimal, DECIMALS) == separator:
        raise InputError("The comma cannot be both separator and decimal mark: change one of them.")
    places = PLACES.whole(decimals)
    angles = _angles(step_deg, points, _INT if form == "codesys" else None)
    texts = {}
    for motion in diagram.motions:
        columns = [[_angle(angle) for angle in angles.tolist()]]
        columns.append(_fixed(positions_over_turn(motion, angles), places))
        heading = ["cam angle in deg", "position in mm"]
        for order, what in _ORDERS.items() if derivatives else ():
            values = _derivative(diagram, motion, order, angles, derivatives == "s")
            columns.append(_fixed(values, _places_for(values, places)))
            heading.append(f"{what} in {_UNITS[str(derivatives)]}{order if order > 1 else ''}")
        rows = (separator.join(cells).replace(".", decimal) for cells in zip(*columns, strict=True))
        first = [separator.join(heading)] if form == "plain" else []
        texts[motion.name] = "\r\n".join([*first, *rows, ""])
    return _write(texts, folder, ".csv" if form == "plain" else ".txt", overwrite=overwrite)


def _angles(step_deg: float | None, points: int | None, most: int | None) -> Floats:
    """Return the angles from 0 to 360 deg; raise InputError for steps that do not fill the turn."""
    if step_deg is not None and points is not None:
        raise InputError("Both step_deg and points are given: give one of the two.")
    if points is not None:
        steps = POINTS.whole(points) - 1
    else:
        step = STEP_DEG.number(1 if step_deg is None else step_deg)
        parts = DEG_PER_TURN / step
        steps = round(parts)
        if abs(parts - steps) > _WHOLE * parts:
            near = (math.floor(parts), math.ceil(parts))
            raise InputError(
                f"The step of a cam table is {step:g} deg, which does not divide 360 deg "
                f"({parts:.6g} steps): give points={near[0] + 1} (steps of "
                f"{DEG_PER_TURN / near[0]:.6g} deg) or points={near[1] + 1} (steps of "
                f"{DEG_PER_TURN / near[1]:.6g} deg)."
            )
    if most and steps >= most:
        raise InputError(
            f"A cam of CODESYS has at most {most} points, and these are {steps + 1}: give a larger "
            "step, or points=256."
        )
    return np.round(DEG_PER_TURN * np.arange(steps + 1) / steps, ANGLE_DECIMALS)


def positions_over_turn(motion: Motion, angles: Floats) -> Floats:
    """Return the positions in mm over a turn that begins at 0 deg; it closes, or is a pitch on.

    A turret is alike after its whole turns: of these the first position is as near as can be to
    the stops between which the motion was typed.
    """
    turns, phase = into_turn(angles, motion.start_deg)
    positions: Floats = motion.curve(phase) + motion.pitch_mm * turns
    positions += motion.position_mm(0) - positions[0]
    if motion.stops:
        turret_mm = motion.stops * abs(motion.pitch_mm)
        near_mm = motion.start_mm + _NEAR * motion.pitch_mm
        positions -= turret_mm * np.round((positions[0] - near_mm) / turret_mm)
    positions[-1] = positions[0] + motion.pitch_mm
    return positions


def _derivative(
    diagram: TimingDiagram, motion: Motion, order: int, angles: Floats, per_second: bool
) -> Floats:
    """Return a derivative in mm by the cam angle in deg or by the time in s."""
    begun = motion.curve.begun(into_turn(angles, motion.start_deg)[1])
    values = motion.curve.derived(order)(begun, "right")
    values[-1] = values[0]
    if per_second:
        values = np.asarray(over_time(order, values, diagram.cycle_time_s)) * MM_PER_M
    return values


def _angle(angle: float) -> str:
    """Return an angle with one decimal at least: it shows the decimal mark."""
    text = f"{angle:.{ANGLE_DECIMALS}f}".rstrip("0")
    return text + "0" if text.endswith(".") else text


def _fixed(values: Floats, places: int) -> list[str]:
    """Return numbers with so many decimals, those alike that differ by a float's rounding alone."""
    return [f"{value:z.{places}f}" for value in np.round(values, places + _FINER).tolist()]


def _places_for(values: Floats, places: int) -> int:
    """Return the decimals with which the largest value has `places` behind its first digit.

    No more than a float has: what would stand behind is no part of the number.
    """
    largest = float(np.abs(values).max())
    before = math.floor(math.log10(largest)) if largest else 0
    return max(min(places - min(before, 0), _DIGITS - before), 0)


def _write(
    texts: dict[str, str], folder: str | Path, ending: str, *, overwrite: bool
) -> dict[str, Path]:
    """Write all the files, unless one of them is there already, or none."""
    place = as_path(folder)
    remedy = "make it, or give another one; each mechanism gets a file of its own in it"
    check_folder(place, shorten(place.name), remedy)
    paths = {
        name: place / f"{stem}{ending}" for name, stem in zip(texts, stems(texts), strict=True)
    }
    there = [path.name for path in paths.values() if path.exists()]
    if there and overwrite is not True:
        raise InputError(
            f"The file {there[0]} is there already, and nothing was written: choose another "
            "folder, or add overwrite=True."
        )
    write_all({paths[name]: text for name, text in texts.items()}, overwrite=overwrite)
    return paths
