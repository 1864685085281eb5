"""Tables of drawn motions: their differences, harmonics, smoothing and rounding, by other ways.

What is sampled comes from the laws' expressions; the other ways are parabolas through three points,
least squares, and SciPy's interpolating spline, from which the penalty of bending is built anew.
"""

import warnings
from itertools import product
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

import cammotion as cm
from fresh.drawing import Machine
from fresh.sampling import Array, tracks_of

RATE = 1700.0  # turns an hour


def differences(machine: Machine) -> None:
    """Lay parabolas through three neighbours, and try all signs of their errors."""
    for table in _tables(machine, most=60):
        found = cm.differences(table, RATE)
        angles, y = _with_neighbours(table)
        times = angles / 360 * 3600 / RATE
        for n in range(found.angle_deg.size):
            t, near = times[n : n + 3] - times[n + 1], y[n : n + 3] / 1000
            slope, bend = np.linalg.solve(np.vander(t, 3, increasing=True), near)[1:]
            _same(found.velocity[n], slope, np.abs(found.velocity).max(), "velocity")
            _same(found.acceleration[n], 2 * bend, np.abs(found.acceleration).max(), "bend")
            corners = np.array([*product((-1, 1), repeat=3)]).T * 0.01 / 1000
            worst = np.abs(2 * np.linalg.solve(np.vander(t, 3, increasing=True), corners)[2]).max()
            _same(found.acceleration_bound(0.01)[n], worst, worst, "bound")


def harmonics(machine: Machine) -> None:
    """Fit cosines and sines by least squares."""
    for table in _tables(machine, most=80, kinds=("even cycle",)):
        found, count = cm.harmonics(table), table.angle_deg.size
        angle = np.radians(table.angle_deg)
        rank = np.arange(1, (count - 1) // 2 + 1)
        waves = np.multiply.outer(angle, rank)
        fitted = np.linalg.lstsq(
            np.column_stack([np.ones(count), np.cos(waves), np.sin(waves)]), table.position_mm
        )[0]
        half = rank.size
        size = np.ptp(table.position_mm)
        for n in range(half):
            wanted = np.hypot(fitted[1 + n], fitted[1 + half + n])
            _same(found.amplitude_mm[n], wanted, size, f"harmonic {n + 1}")
        _same(found.mean_mm, fitted[0], size, "mean")
        back = found.rebuilt(len(found.rank), table.angle_deg)
        _same(np.asarray(back), table.position_mm, size, "all of them")


def smoothings(machine: Machine) -> None:
    """Solve for the values that are near and bend little, the bending by SciPy's spline."""
    for table in _tables(machine, most=45):
        amount = 10.0 ** machine.rng.uniform(-8, 0)
        found = cm.smoothed(table, amount)
        places = np.radians(table.angle_deg)
        bends = _bends(places, is_cycle=table.is_cycle)
        length = 2 * np.pi if table.is_cycle else float(np.ptp(places))
        count = places.size
        solved = np.linalg.inv(np.eye(count) + amount * count / length * _penalty(places, bends))
        size = np.ptp(table.position_mm) + 1e-9
        first = table.position_mm[0]  # what is level stays: else its rounding would be magnified
        known = first + solved @ (table.position_mm - first)
        _same(found.position_mm, known, size, "values", 1e-6)
        shares = bends[:count] @ solved
        wanted = np.sqrt(np.sum(shares**2, axis=1))
        per_second = 2 * np.pi * RATE / 3600
        bars = found.acceleration_rms(RATE, 0.01) * 1000 / per_second**2 / 0.01
        _same(bars, wanted, wanted.max(), "error bars", 1e-5)


def roundings(machine: Machine) -> None:
    """Change each point of a law by itself, and sum what that does to A."""
    rng = machine.rng
    for motion in machine.diagram.motions[:2]:
        law = cm.as_law(motion.moves[0].law) if motion.moves else cm.LAWS["cycloidal"]
        count = int(rng.integers(12, 50))
        inner = np.sort(rng.uniform(0.01, 0.99, count - 2))
        even = np.linspace(0, 1, count)
        x = even if rng.random() < 0.5 or np.diff(inner).min() < 1e-3 else np.r_[0, inner, 1]
        s = np.clip(law(x), -1, 2).round(3)
        s[[0, -1]] = 0, 1
        slopes = [float(slope) for slope in rng.uniform(-1, 1, 2)]
        with warnings.catch_warnings(action="ignore"):
            sampled = cm.law_from_points(x, s, step=0.001, end_slopes=(slopes[0], slopes[1]))
        ends = [(1, slope) for slope in slopes]
        there = CubicSpline(x, s, bc_type=ends)
        _same(sampled(x), s, 1, "points")
        _same(sampled(x, 2), there(x, 2), np.abs(there(x, 2)).max(), "A")
        units = CubicSpline(x, np.eye(count)[:, 1:-1], bc_type=[(1, np.zeros(count - 2))] * 2)
        shares = np.abs(units(x, 2))
        bound = 0.0005 * shares.sum(axis=1).max()
        rms = 0.0005 / np.sqrt(3) * np.sqrt((shares**2).sum(axis=1)).max()
        _same(sampled.rounding.bound, bound, bound, "bound", 1e-6)
        _same(sampled.rounding.rms, rms, rms, "rms", 1e-6)


def eccentrics(machine: Machine) -> None:
    """Write out cams of three harmonics, which turn right beside a point or anywhere.

    A cubic spline is off by at most 5/384 of the fourth power of its step times the fourth
    derivative, and its bend by 3/8 of the square. For the turns a point may be moved by 0.005 deg,
    and what turns back by less than 1e-5 of the travel may be left out.
    """
    rng = machine.rng
    count, first = int(rng.integers(8, 900)), 10.0 ** rng.uniform(-1, 2)
    second, third = first * 10.0 ** rng.uniform(-9, -0.8), first * rng.choice([0, 0.05, 0.5])
    step = 360 / count
    begins = step * rng.integers(count) + step * 10.0 ** rng.uniform(-9, 0)

    def height(at: Array) -> Array:
        a = np.radians(at - begins)
        waves = -first * np.cos(a) + second * np.sin(2 * a) + third * np.sin(3 * a)
        return np.asarray(7 + waves)

    angles = np.arange(0.0, count) * step
    cam = cm.motion_from_table("cam", cm.CamTable(angles, height(angles), is_cycle=True))
    assert cam.steps(1) == cam.steps(2) == [], "a jump"
    at, width = rng.uniform(0, 360, 2000), np.radians(step)
    bend, fourth = first + 4 * second + 9 * third, first + 16 * second + 81 * third
    near = 5 / 384 * width**4 * fourth + np.radians(0.005) ** 2 * bend + 2e-5 * bend
    _same(cam.position_mm(at), height(at), 1, "height", near)
    a = np.radians(np.arange(0, 360, 0.01))
    waves = first * np.cos(a) - 4 * second * np.sin(2 * a) - 9 * third * np.sin(3 * a)
    off = (3 / 8 * width**2 * fourth + 1e-3 * bend) * np.radians(1) ** 2
    _same(cam.peak(2), np.abs(waves).max() * np.radians(1) ** 2, 1, "peak", off)


def levelled(machine: Machine) -> None:
    """Cut a cam of two harmonics off at a height, above which it stands, turned to anywhere."""
    rng = machine.rng
    count = int(rng.integers(90, 900))
    step, level = 360 / count, rng.uniform(-0.7, 0.9)
    angles = rng.uniform(0, step) + np.arange(0.0, count) * step
    a = np.radians(angles - rng.uniform(0, 360))
    heights = 20 * np.minimum(-np.cos(a) + 0.2 * np.sin(2 * a), level)
    cam = cm.motion_from_table("cam", cm.CamTable(angles, heights, is_cycle=True))
    assert cam.steps(1) == [], "a jump"
    assert "dwell" in {segment.kind for segment in cam.segments}
    _same(cam.position_mm(angles), heights, 1, "height", 1e-3)


def noisy(machine: Machine) -> None:
    """Measure a cam that dwells twice, or never; see that its motion is that of the smoothed table.

    Dwells are within six times the error, and what turns back by less is left out; a dwell may
    change the acceleration by three tenths of its peak.
    """
    rng = machine.rng
    count, travel = int(rng.integers(180, 720)), 10.0 ** rng.uniform(0, 2)
    angles = rng.uniform(0, 1) + np.arange(0.0, count) * 360 / count
    up, down, stay = rng.uniform(40, 120), rng.uniform(40, 120), rng.choice([0, 20, 80])
    since = (angles - rng.uniform(0, 360)) % 360
    law = cm.LAWS[str(rng.choice(["cycloidal", "modified sine", "3-4-5 polynomial"]))]
    rise, back = np.clip(since / up, 0, 1), np.clip((since - up - stay) / down, 0, 1)
    noise = travel * 10.0 ** rng.uniform(-5, -3)
    heights = travel * (law(rise) - law(back)) + rng.normal(0, noise, count)
    smooth = cm.smoothed(cm.CamTable(angles, heights, is_cycle=True))
    if smooth.error_mm < noise / 2:  # few of these tables deceive the cross-validation
        return
    cam = cm.motion_from_table("cam", smooth)
    assert cam.steps(1) == [], "a jump"
    at, rate = np.arange(0, 360, 0.05), 900.0
    _same(cam.position_mm(at), smooth.at(at), 1, "height", 6 * smooth.error_mm)
    peak = cm.TimingDiagram([cam], rate).peak_acceleration("cam")
    wanted = np.abs(np.asarray(smooth.at(at, 2, rate_per_hour=rate))).max()
    _same(peak, wanted, wanted, "peak", 0.32)


def _tables(machine: Machine, most: int, kinds: tuple[str, ...] = ()) -> list[cm.CamTable]:
    """Draw tables of the motions that come back: even and uneven, cycles and parts, with noise."""
    rng, tables = machine.rng, []
    for name, track in tracks_of(machine.diagram).items():
        if machine.diagram[name].is_indexing:
            continue
        kind = str(rng.choice(kinds or ("even cycle", "uneven cycle", "even part", "uneven part")))
        count = int(rng.integers(8, most))
        steps = rng.uniform(0.3, 1, count + 1) if kind.startswith("uneven") else np.ones(count + 1)
        angles = np.cumsum(steps)[:count] / steps.sum()
        angles = rng.uniform(-400, 400) + 360 * angles * (1 if "cycle" in kind else 0.6)
        if kind == "even cycle":
            angles = angles[0] + 360 / count * np.arange(count)
        y = track.curve(0, angles % 360) + rng.normal(0, 10.0 ** rng.uniform(-4, 0), count)
        tables.append(cm.CamTable(angles, y, is_cycle="cycle" in kind))
    return tables


def _with_neighbours(table: cm.CamTable) -> tuple[Array, Array]:
    angles, y = table.angle_deg, table.position_mm
    if not table.is_cycle:
        return angles, y
    return np.r_[angles[-1] - 360, angles, angles[0] + 360], np.r_[y[-1], y, y[0]]


def _bends(places: Array, *, is_cycle: bool) -> Array:
    """Return f'' at the knots (the first once more at the end of a cycle) by the values there."""
    units = np.eye(places.size)
    if is_cycle:
        places, units = np.append(places, places[0] + 2 * np.pi), np.vstack([units, units[:1]])
    spline = CubicSpline(places, units, bc_type="periodic" if is_cycle else "natural")
    return np.asarray(spline(places, 2))


def _penalty(places: Array, bends: Array) -> Array:
    """Return the matrix of the integral of f''^2, which is straight between two knots."""
    if len(bends) > places.size:
        places = np.append(places, places[0] + 2 * np.pi)
    low, high, widths = bends[:-1], bends[1:], np.diff(places)[:, None] / 6
    return np.asarray(
        2 * (low * widths).T @ low
        + (low * widths).T @ high
        + (high * widths).T @ low
        + 2 * (high * widths).T @ high
    )


def _same(mine: Any, wanted: Any, size: Any, what: str, near: float = 1e-7) -> None:
    off = np.max(np.abs(np.asarray(mine) - wanted))
    assert off <= near * size, f"{what}: {off} off"
