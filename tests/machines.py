"""The running example, motion laws to try, and the same curves written out once more in NumPy.

What stands here in NumPy knows nothing of the package: no law, no arc, no solver.
"""

import os
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
import sympy
from hypothesis import HealthCheck, settings
from numpy.typing import NDArray

import cammotion as cm
from cammotion import MotionLaw, x
from cammotion.machine.motions import Motion
from cammotion.rules.clearance import ClearanceRule

Array: TypeAlias = NDArray[np.float64]
Curve: TypeAlias = Callable[[Any], Any]

RATE = 2000
DOWN_DEG = (205, 305)  # where the die works
HALF = cm.MotionLaw("half", cm.x**2 * (3 - 2 * cm.x) / 2)  # at rest at both ends, and no move
RULE = ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 0.65))


def examples(number: int) -> settings:
    """Return the settings of a property, with no limit of time: always the same examples.

    With FRESH_EXAMPLES=4 in the environment they are drawn anew, four times as many.
    """
    times = int(os.environ.get("FRESH_EXAMPLES", "0"))
    return settings(
        max_examples=number * max(times, 1),
        derandomize=not times,
        deadline=None,
        suppress_health_check=[HealthCheck.too_slow] if times else [],
    )


def make_mill(
    angle_deg: float = 150, *, middle_deg: float = 75, law: str | MotionLaw = "cycloidal"
) -> Motion:
    """Return the indexing mill, moving about a middle angle."""
    return cm.indexing_motion(
        "mill",
        cm.rise(100, over_deg=angle_deg, law=law),
        *([cm.dwell(360 - angle_deg)] if angle_deg < 360 else []),
        stops=24,
        start_deg=middle_deg - angle_deg / 2,
    )


def make_die(
    angle_deg: float = 55,
    *,
    up_deg: float | None = None,
    stroke_mm: float = 50,
    down_deg: tuple[float, float] = DOWN_DEG,
    law: str | MotionLaw = "cycloidal",
) -> Motion:
    """Return the die, down to do its work from one cam angle to another.

    It comes down over an angle, and goes up over the same one, or over `up_deg`.
    """
    start, end = down_deg
    up_deg = angle_deg if up_deg is None else up_deg
    rest = 360 - angle_deg - up_deg - (end - start)
    return cm.motion(
        "die",
        cm.rise(stroke_mm, over_deg=angle_deg, law=law),
        cm.dwell(end - start),
        cm.return_(stroke_mm, over_deg=up_deg, law=law),
        *([cm.dwell(rest)] if rest > 0 else []),
        start_deg=start - angle_deg,
    )


def make_diagram(*motions: Motion) -> cm.TimingDiagram:
    """Return the timing diagram of the motions, or of mill and die without overlap."""
    return cm.TimingDiagram(motions or (make_mill(), make_die()), RATE)


def _gutman() -> Any:
    once, thrice = (sympy.sin(n * sympy.pi * x) for n in (2, 6))
    return x - (15 * once / 32 + thrice / 96) / sympy.pi


def _parabolic() -> Any:
    return sympy.Piecewise((2 * x**2, x <= sympy.Rational(1, 2)), (1 - 2 * (1 - x) ** 2, True))


def _modified_sine() -> Any:
    pi, eighth = sympy.pi, sympy.Rational(1, 8)
    ends = pi * x - sympy.sin(4 * pi * x) / 4
    middle = 2 + pi * x - 9 * sympy.sin((4 * pi * x + pi) / 3) / 4
    pieces = (ends, x <= eighth), (middle, x <= 7 * eighth), (ends + 4, True)
    return sympy.Piecewise(*pieces) / (4 + pi)


MONOTONE = [
    cm.LAWS["cycloidal"],
    MotionLaw("3-4-5", 10 * x**3 - 15 * x**4 + 6 * x**5),
    MotionLaw("4-5-6-7", 35 * x**4 - 84 * x**5 + 70 * x**6 - 20 * x**7),
    MotionLaw("cubic 2-3", 3 * x**2 - 2 * x**3),
    MotionLaw("harmonic", (1 - sympy.cos(sympy.pi * x)) / 2),
    MotionLaw("Gutman", _gutman()),
    MotionLaw("parabolic", _parabolic()),
    MotionLaw("mod. sine", _modified_sine()),
]
DIPPING = MotionLaw("dipping", x**2 * (5 * x - 2) / 3)  # below 0 until x = 2/5, lowest at 4/15
OVERSHOOTING = MotionLaw("overshooting", 1 - DIPPING.s.subs(x, 1 - x))
WAVY = MotionLaw("wavy", x - sympy.sin(6 * sympy.pi * x) / 4)
TURNING = [DIPPING, OVERSHOOTING, WAVY]


def _parabola(s: Array) -> Array:
    return np.where(s <= 0.5, 2 * s**2, 1 - 2 * (1 - s) ** 2)


def _modified_sine_curve(s: Array) -> Array:
    ends = np.pi * s - np.sin(4 * np.pi * s) / 4
    middle = 2 + np.pi * s - 9 / 4 * np.sin((4 * np.pi * s + np.pi) / 3)
    return np.where(s <= 1 / 8, ends, np.where(s <= 7 / 8, middle, ends + 4)) / (4 + np.pi)


CURVES: dict[str, Curve] = {
    "cycloidal": lambda s: s - np.sin(2 * np.pi * s) / (2 * np.pi),
    "3-4-5": lambda s: s**3 * (10 + s * (-15 + 6 * s)),
    "4-5-6-7": lambda s: s**4 * (35 + s * (-84 + s * (70 - 20 * s))),
    "cubic 2-3": lambda s: s**2 * (3 - 2 * s),
    "harmonic": lambda s: (1 - np.cos(np.pi * s)) / 2,
    "Gutman": lambda s: (
        s - 15 / (32 * np.pi) * np.sin(2 * np.pi * s) - np.sin(6 * np.pi * s) / (96 * np.pi)
    ),
    "parabolic": _parabola,
    "mod. sine": _modified_sine_curve,
    "dipping": lambda s: s**2 * (5 * s - 2) / 3,
    "overshooting": lambda s: 1 - (1 - s) ** 2 * (5 * (1 - s) - 2) / 3,
    "wavy": lambda s: s - np.sin(6 * np.pi * s) / 4,
}
"""S(x) of the laws above."""


def die_mm(
    cam_deg: Array,
    angle_deg: float | Array = 55,
    *,
    stroke_mm: float = 50,
    down_deg: tuple[float, float] = DOWN_DEG,
    curve: Curve = CURVES["cycloidal"],
) -> Array:
    """Return how deep the die is."""
    start, end = down_deg
    since_down = (cam_deg - start) % 360
    up = np.clip((since_down - (end - start)) / angle_deg, 0, 1)
    down = np.clip((since_down - 360) / angle_deg + 1, 0, 1)
    return np.asarray(stroke_mm * (1 - curve(up) + curve(down)))


def mill_off_mm(
    cam_deg: Array,
    angle_deg: float | Array = 150,
    *,
    middle_deg: float = 75,
    curve: Curve = CURVES["cycloidal"],
) -> Array:
    """Return how far the mill is from the nearest stop."""
    since_middle = (cam_deg - middle_deg + 180) % 360 - 180
    passed = 100 * curve(np.clip(since_middle / angle_deg + 0.5, 0, 1)) % 100
    return np.asarray(np.minimum(passed, 100 - passed))
