"""The workbook of a report: the machine, its peaks and clearances, and the cam tables."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from cammotion.exchange.cam_tables_out import positions_over_turn
from cammotion.exchange.machine_files import machine_rows
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.own import Machine
from cammotion.quantities import Floats
from cammotion.report.findings import Findings
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.conditions import Condition, Moving
from cammotion.rules.distance import DistanceRule
from cammotion.rules.rule import Rule

STEP_DEG = 0.5
"""Of the cam tables: fine enough for a spline through them."""

_PLACES, _DIGITS = 7, 6  # of a number in a cam table at least: decimals, or digits of the largest
_MECHANISMS = (
    "mechanism",
    "indexing stops",
    "stop in mm",
    "pitch in mm",
    "peak velocity in m/s",
    "peak acceleration in m/s2",
)
_RULES = (
    "mechanism",
    "side",
    "limit in mm",
    "other mechanism",
    "only while it is",
    "limit of it in mm",
    "clearance in mm",
)
_OF_DESIGN = "peak acceleration of the design in m/s2", "clearance of the design in mm"
_CURVES = ("position in mm", "velocity in m/s", "acceleration in m/s2")


def sheets_of(found: Findings) -> dict[str, list[list[Any]]]:
    """Return the sheets of the workbook by their names; the first can be read as a machine."""
    machine = found.machine
    designs = [machine, found.improved] if found.best else [machine]
    peak, clearance = ([column] if found.best else [] for column in _OF_DESIGN)
    sheets: dict[str, list[list[Any]]] = {"machine": machine_rows(machine)}
    if found.best:
        sheets["design"] = machine_rows(found.improved)
    sheets["mechanisms"] = [[*_MECHANISMS, *peak], *_mechanisms(designs)]
    sheets["rules"] = [[*_RULES, *clearance], *_rules(designs)]
    for motion in machine.diagram.motions:
        sheets[f"cam {motion.name}"] = _cam(motion.name, *(one.diagram for one in designs))
    return sheets


def _mechanisms(designs: Sequence[Machine]) -> list[list[Any]]:
    rows, machine = [], designs[0]
    for motion in machine.diagram.motions:
        name = motion.name
        peaks = [machine.diagram.peak_velocity(name), *(one.peaks[name] for one in designs)]
        stop = motion.start_mm if motion.is_indexing else ""
        rows.append([name, motion.stops or "", stop, motion.pitch_mm, *map(_finite, peaks)])
    rows.append(["machine rate in pieces/h", machine.diagram.rate_per_hour])
    return rows


def _rules(designs: Sequence[Machine]) -> list[list[Any]]:
    left = zip(*(machine.clearances for machine in designs), strict=True)
    return [
        [*_said(rule), *(_finite(one.clearance_mm) for one in each)]
        for rule, each in zip(designs[0].rules, left, strict=True)
    ]


def _said(rule: Rule) -> list[Any]:
    """Return the cells of a rule: of a distance the part that stays so far above the other."""
    if isinstance(rule, DistanceRule):
        return [rule.part, "at least above", rule.at_least_mm, rule.above, "", ""]
    halves = (rule.when, rule.only_while) if isinstance(rule, ClearanceRule) else ()
    return [part for half in halves for part in _half(half)]


def _half(condition: Condition) -> tuple[Any, ...]:
    if isinstance(condition, Moving):
        return condition.motion, str(condition), ""
    side = "beyond" if condition.is_beyond else "within"
    return condition.motion, side, condition.limit_mm


def _cam(name: str, *diagrams: TimingDiagram) -> list[list[Any]]:
    """Return the cam table of a mechanism, as it is and as it is designed.

    Its name stands in the heading in full, since that of its sheet may be cut.
    """
    angles = np.arange(0, DEG_PER_TURN + STEP_DEG / 2, STEP_DEG)
    columns = [angles]
    heading = ["cam angle in deg"]
    for diagram, whose in zip(diagrams, ("", " of the design"), strict=False):
        motion = diagram[name]
        values = (
            positions_over_turn(motion, angles),
            diagram.velocity(name, angles),
            diagram.acceleration(name, angles),
        )
        columns += [_rounded(np.asarray(each)) for each in values]
        heading += [f"{what}{whose}" for what in _CURVES]
    return [[*heading, f"cam of the {name}"], *np.column_stack(columns).tolist()]


def _rounded(column: Floats) -> Floats:
    largest = float(np.abs(column).max())
    before = math.floor(math.log10(largest)) + 1 if 0 < largest < math.inf else 0
    return column.round(max(_PLACES, _DIGITS - before)) + 0.0


def _finite(value: float) -> Any:
    return value if math.isfinite(value) else "infinite"
