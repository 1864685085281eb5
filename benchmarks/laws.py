"""What a motion law costs: beside NumPy by hand, beside another package, and when first used."""

import contextlib
import ctypes
import importlib
import os
import subprocess
import sys
from collections.abc import Callable
from itertools import pairwise
from statistics import median
from typing import Any, TypeAlias

import numpy as np
from findings import Finding, ratio_of_medians, say
from numpy import cos, pi, sin
from numpy.typing import NDArray
from package import time_by_turns

from cammotion import LAWS

Array: TypeAlias = NDArray[np.float64]
Curve: TypeAlias = Callable[[Array], Any]
Curves: TypeAlias = tuple[Curve, Curve, Curve, Curve]
"""S, V, A and J, each to be called by itself, as a law's own are."""

_TRIM_THRESHOLD, _MMAP_THRESHOLD = -1, -3  # options of mallopt, in bytes
POINTS = 100_000
ROUNDS = 40
FIRST_USES = 7
FIRST_USE = """
import time
import numpy as np
import sympy
sympy.Symbol("y") + 1  # SymPy imports its tensors at its first sum
places = np.linspace(0, 1, 1000)
started = time.perf_counter()
import cammotion
name = {name!r}
law = cammotion.LAWS[name] if name else cammotion.fifth_degree_linear(0.5)
for derivative in range(4):
    law(places, derivative)
law.Cv, law.Ca, law.Cj
law.inverse(0.3)
print(time.perf_counter() - started)
"""


def measure_laws() -> list[Finding]:
    """Compute s, v, a, j of every law at 100,000 points, and the same by hand in NumPy."""
    keep_freed_memory()
    x = np.linspace(0, 1, POINTS)
    return [
        Finding(f"s, v, a, j of {name} : by hand", ratio_to_hand(name, x), 1.5, "x")
        for name in BY_HAND
    ]


def keep_freed_memory() -> None:
    """Have the C library keep what is freed for the next array, where it can be told (glibc).

    It else gives memory back to the system now and then. Which side of a comparison then has to
    fetch it anew for each array is luck, and takes up to ten times as long as the sums.
    """
    with contextlib.suppress(AttributeError, OSError, TypeError):
        tell = ctypes.CDLL(None).mallopt
        for option in (_TRIM_THRESHOLD, _MMAP_THRESHOLD):
            tell(option, 2**25)  # the most that it takes


def ratio_to_hand(name: str, x: Array) -> float:
    """Return how many times longer a law of the catalogue takes than the one written here."""
    law, curves = LAWS[name], BY_HAND[name]
    for order, curve in enumerate(curves):  # the first call compiles
        if not np.allclose(law(x, order), curve(x), rtol=1e-9, atol=1e-9):
            raise RuntimeError(f"{name} is not what is written by hand")
    own, by_hand = time_by_turns(
        lambda: [law(x, order) for order in range(4)],
        lambda: [curve(x) for curve in curves],
        ROUNDS,
    )
    say(f"{name}: {1e3 * median(own):.2f} ms and by hand {1e3 * median(by_hand):.2f} ms")
    return ratio_of_medians(own, by_hand)


def measure_rival() -> list[Finding]:
    """Compute s, v, a, j at 100,000 points, and the same with the package `mechanism`."""
    try:
        cams = importlib.import_module("mechanism.cams")
    except ModuleNotFoundError:
        sys.exit("Only this measure needs another package: python -m pip install -e '.[benchmark]'")
    cam = cams.Cam([("Rise", 1, 360)], degrees=True, omega=1, h=2 * pi / POINTS)
    x = cam.thetas / (2 * pi)
    return [
        Finding(
            f"s, v, a, j of {name} : with `mechanism`", ratio_to_rival(name, x, rival, cam), 1, "x"
        )
        for name, rival in (("simple harmonic", cams.Harmonic), ("cycloidal", cams.Cycloidal))
    ]


def ratio_to_rival(name: str, x: Array, rival: Any, cam: Any) -> float:
    """Return how many times longer a law takes than the other package's, a rise over one turn."""
    law = LAWS[name]

    def compute() -> list[Array]:
        return [law(x, order) for order in range(4)]

    def compute_there() -> list[Array]:
        made = rival(cam.motion, cam.shifts, cam.intervals, cam.conditions, cam.thetas, omega=1)
        return [made.S, made.V, made.A, made.J]

    for order, (own_curve, curve) in enumerate(zip(compute(), compute_there(), strict=True)):
        if not np.allclose(own_curve, curve * (2 * pi) ** order, rtol=1e-9, atol=1e-9):
            raise RuntimeError(f"{name} is not the same law there")
    own, there = time_by_turns(compute, compute_there, ROUNDS)
    say(f"{name}: {1e3 * median(own):.2f} ms and there {1e3 * median(there):.2f} ms")
    return ratio_of_medians(own, there)


def measure_first_use() -> list[Finding]:
    """Use each law for the first time, in fresh processes: all its curves, factors, inverse."""
    times = {}
    for name in [*LAWS, ""]:
        times[name] = median(time_first_use(name) for _ in range(FIRST_USES))
        say(f"{name or 'fifth degree + linear'}: {1e3 * times[name]:.0f} ms")
    slowest = max(times, key=lambda name: times[name])
    what = f"first use of a law, the slowest ({slowest or 'fifth degree + linear'})"
    return [Finding(what, times[slowest], 0.1, "s")]


def time_first_use(name: str) -> float:
    """Return the time in s of a first use after NumPy and SymPy were, and SymPy had its first sum.

    Python may keep the modules that it has compiled, as it does on a learner's computer.
    """
    ran = subprocess.run(
        [sys.executable, "-c", FIRST_USE.format(name=name)],
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": ""},
        check=True,
        capture_output=True,
        text=True,
    )
    return float(ran.stdout)


def in_zones(joints: list[float], *curves: Curve) -> Curve:
    """Return the curve that is put together from these; each gets its own places, in order."""

    def curve(x: Array) -> Array:
        values = np.empty_like(x)
        ends = [0, *np.searchsorted(x, joints), x.size]
        for piece, (start, end) in zip(curves, pairwise(ends), strict=True):
            values[start:end] = piece(x[start:end])
        return values

    return curve


def _zones(joints: list[float], *curves: Curves) -> Curves:
    s, v, a, j = (in_zones(joints, *pieces) for pieces in zip(*curves, strict=True))
    return s, v, a, j


def _sines(first: float, third: float, fifth: float = 0) -> Curves:
    """Return x less sines of 1, 3 and 5 periods; those of no amplitude are not computed."""
    w = 2 * pi
    a, b, c = first, third, fifth
    if c:
        return (
            lambda x: x - (a * sin(w * x) + b * sin(3 * w * x) + c * sin(5 * w * x)) / w,
            lambda x: 1 - a * cos(w * x) - 3 * b * cos(3 * w * x) - 5 * c * cos(5 * w * x),
            lambda x: w * (a * sin(w * x) + 9 * b * sin(3 * w * x) + 25 * c * sin(5 * w * x)),
            lambda x: w**2 * (a * cos(w * x) + 27 * b * cos(3 * w * x) + 125 * c * cos(5 * w * x)),
        )
    return (
        lambda x: x - (a * sin(w * x) + b * sin(3 * w * x)) / w,
        lambda x: 1 - a * cos(w * x) - 3 * b * cos(3 * w * x),
        lambda x: w * (a * sin(w * x) + 9 * b * sin(3 * w * x)),
        lambda x: w**2 * (a * cos(w * x) + 27 * b * cos(3 * w * x)),
    )


def _modified_trapezoid() -> Curves:
    w = 4 * pi
    peak = 8 * pi / (2 + pi)
    v_1, s_1 = peak / w, peak / w * (1 / 8 - 1 / w)
    v_2, s_2 = v_1 + peak / 4, s_1 + v_1 / 4 + peak / 32
    return _zones(
        [1 / 8, 3 / 8, 5 / 8, 7 / 8],
        (
            lambda x: v_1 * (x - sin(w * x) / w),
            lambda x: v_1 * (1 - cos(w * x)),
            lambda x: peak * sin(w * x),
            lambda x: peak * w * cos(w * x),
        ),
        (
            lambda x: s_1 + (x - 1 / 8) * (v_1 + peak / 2 * (x - 1 / 8)),
            lambda x: v_1 + peak * (x - 1 / 8),
            lambda _: peak,
            lambda _: 0,
        ),
        (
            lambda x: s_2 + v_2 * (x - 3 / 8) + v_1 / w * (1 - cos(w * (x - 3 / 8))),
            lambda x: v_2 + v_1 * sin(w * (x - 3 / 8)),
            lambda x: peak * cos(w * (x - 3 / 8)),
            lambda x: -peak * w * sin(w * (x - 3 / 8)),
        ),
        (
            lambda x: 1 - s_1 - (7 / 8 - x) * (v_1 + peak / 2 * (7 / 8 - x)),
            lambda x: v_1 + peak * (7 / 8 - x),
            lambda _: -peak,
            lambda _: 0,
        ),
        (
            lambda x: 1 - v_1 * (1 - x - sin(w * (1 - x)) / w),
            lambda x: v_1 * (1 - cos(w * (1 - x))),
            lambda x: -peak * sin(w * (1 - x)),
            lambda x: peak * w * cos(w * (1 - x)),
        ),
    )


def _modified_sine_ends(size: float, w: float, start: float, base: float) -> Curves:
    """Return a zone that begins or ends at rest; `w` is pi times 4 over the time of the motion."""
    return (
        lambda x: base + size * ((x - start) * w - sin(w * (x - start))),
        lambda x: size * w * (1 - cos(w * (x - start))),
        lambda x: size * w**2 * sin(w * (x - start)),
        lambda x: size * w**3 * cos(w * (x - start)),
    )


def _modified_sine_middle(size: float, w: float, start: float, base: float) -> Curves:
    """Return the zone with the long sine."""
    third = w / 3
    return (
        lambda x: base + size * ((x - start) * w + 8 - 9 * sin(third * (x - start) + pi / 3)),
        lambda x: size * w * (1 - 3 * cos(third * (x - start) + pi / 3)),
        lambda x: size * w**2 * sin(third * (x - start) + pi / 3),
        lambda x: size * w**2 * third * cos(third * (x - start) + pi / 3),
    )


def _modified_sine() -> Curves:
    size, w = 1 / (4 * (4 + pi)), 4 * pi
    return _zones(
        [1 / 8, 7 / 8],
        _modified_sine_ends(size, w, 0, 0),
        _modified_sine_middle(size, w, 0, 0),
        _modified_sine_ends(size, w, 1, 1),
    )


def _mcv50() -> Curves:
    velocity = 8 * pi / (4 + 5 * pi)
    steepest = 4 * pi / (4 + pi)
    size, w = velocity / 2 / steepest / (4 * (4 + pi)), 8 * pi
    height = velocity / 2 / steepest
    return _zones(
        [1 / 16, 1 / 4, 3 / 4, 15 / 16],
        _modified_sine_ends(size, w, 0, 0),
        _modified_sine_middle(size, w, 0, 0),
        (
            lambda x: 0.5 + velocity * (x - 0.5),
            lambda _: velocity,
            lambda _: 0,
            lambda _: 0,
        ),
        _modified_sine_middle(size, w, 0.5, 1 - height),
        _modified_sine_ends(size, w, 1, 1),
    )


_m = 1125 / 1192
BY_HAND: dict[str, Curves] = {
    "constant acceleration": _zones(
        [1 / 2],
        (lambda x: 2 * x * x, lambda x: 4 * x, lambda _: 4, lambda _: 0),
        (
            lambda x: 1 - 2 * (1 - x) * (1 - x),
            lambda x: 4 * (1 - x),
            lambda _: -4,
            lambda _: 0,
        ),
    ),
    "simple harmonic": (
        lambda x: (1 - cos(pi * x)) / 2,
        lambda x: pi / 2 * sin(pi * x),
        lambda x: pi**2 / 2 * cos(pi * x),
        lambda x: -(pi**3) / 2 * sin(pi * x),
    ),
    "cycloidal": (
        lambda x: x - sin(2 * pi * x) / (2 * pi),
        lambda x: 1 - cos(2 * pi * x),
        lambda x: 2 * pi * sin(2 * pi * x),
        lambda x: 4 * pi**2 * cos(2 * pi * x),
    ),
    "modified trapezoid": _modified_trapezoid(),
    "modified sine": _modified_sine(),
    "3-4-5 polynomial": (
        lambda x: x * x * x * (10 + x * (-15 + 6 * x)),
        lambda x: x * x * (30 + x * (-60 + 30 * x)),
        lambda x: x * (60 + x * (-180 + 120 * x)),
        lambda x: 60 + x * (-360 + 360 * x),
    ),
    "4-5-6-7 polynomial": (
        lambda x: x * x * x * x * (35 + x * (-84 + x * (70 - 20 * x))),
        lambda x: x * x * x * (140 + x * (-420 + x * (420 - 140 * x))),
        lambda x: x * x * (420 + x * (-1680 + x * (2100 - 840 * x))),
        lambda x: x * (840 + x * (-5040 + x * (8400 - 4200 * x))),
    ),
    "Gutman 1-3": _sines(15 / 16, 1 / 48),
    "Freudenstein 1-3": _sines(27 / 28, 1 / 84),
    "Freudenstein 1-3-5": _sines(_m, _m / 54, _m / 1250),
    "cubic": (
        lambda x: x * x * (3 - 2 * x),
        lambda x: x * (6 - 6 * x),
        lambda x: 6 - 12 * x,
        lambda x: np.full_like(x, -12),
    ),
    "MCV50": _mcv50(),
}
"""The catalogue as one would write it with pencil and NumPy, knowing nothing of the package."""
