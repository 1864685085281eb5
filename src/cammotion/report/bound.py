"""What a report says of its bound: of whose motions it is true, and what it does not ask for."""

import math

from cammotion.own import Machine
from cammotion.quantities import outward
from cammotion.report.findings import Findings
from cammotion.whole.optimise import Optimised

_SAME = 1e-6  # of its way, two heights of a part


def free_parts(machine: Machine, all_of_them: str) -> str:
    """Return the parts that have still arcs by name, or in words if these are all that move."""
    moving = (motion.name for motion in machine.diagram.motions if motion.moves)
    names = " and the ".join(machine.free)
    return all_of_them if {*moving} == {*machine.free} else f"the {names}"


def stay(machine: Machine) -> list[str]:
    """Return the parts that move and have no still arcs, that with the largest peak first."""
    moving = (name for name in machine.peaks if machine.diagram[name].moves)
    return [name for name in moving if name not in machine.free]


def bound_said(found: Findings) -> str:
    """Return in a sentence how near to what no motions can be below is what was found.

    That is the design, and where there is none, motions that keep the rules, if any were found.
    """
    least, best = found.least, found.best
    if least is None:
        return ""
    whose = free_parts(found.machine, "these parts")
    if least.can_stand:
        return (
            f"Nothing in the table makes {whose} move, so that no bound is above 0: say of more "
            "than one dwell in the column 'still' that a part has to stand there."
        )
    reached = max(best.peaks.values()) if best else least.reached
    low, high = outward(least.bound, reached)
    sentence = f"No motions of {whose} can have a largest peak below {low} m/s²"
    if best and least.bound > 0 and math.isfinite(reached):
        above = math.ceil(100 * (reached / least.bound - 1))
        sentence += f", so that the design, with {high}, is at most {above} % above the best"
    elif least.design and not best:
        sentence += (
            f"; there is no design, but motions that keep their rules were found, with {high}"
        )
    return f"{sentence}."


def design_said(best: Optimised) -> str:
    """Return in words how near the design is to the best of all starts and angles."""
    trusted = "as far as the solver HiGHS can be trusted"
    checked = "The rules and peaks of the design were checked by their curves."
    if best.is_best:
        of_all = "the best of all starts and angles with these laws, to a thousandth"
        return f"The design is {of_all}, {trusted}. {checked}"
    low, high = outward(best.bound, best.reached)
    if not best.bound:
        return f"The design has {high} m/s², and no bound is known of it. {checked}"
    return (
        f"The design has {high} m/s², and with these laws none has less than {low}, {trusted}: the "
        f"time was too short to search all starts and angles through. {checked}"
    )


def one_height_said(found: Findings) -> str:
    """Return in a sentence of which parts no stroke was asked, or "" if of each one was."""
    held = [name for name in found.machine.free if _has_one_height(found.machine, name)]
    if not held or found.least is None or found.least.can_stand:
        return ""
    return (
        f"The bound asks no stroke of the {' and the '.join(held)}: the table holds "
        f"{'each of them' if len(held) > 1 else 'it'} at one height only. Say of more than one "
        "dwell in the column 'still' that a part has to stand there, if it has to go all its way."
    )


def _has_one_height(machine: Machine, name: str) -> bool:
    """Tell whether a part that comes back stands at one height wherever it has to stand."""
    motion = machine.diagram[name]
    if motion.is_indexing:  # it has a pitch to go in each turn
        return False
    low, high = motion.range_mm
    heights = [float(motion.position_mm((start + end) / 2)) for start, end in machine.free[name]]
    return max(heights) - min(heights) <= _SAME * (high - low)
