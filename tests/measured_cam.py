"""The handbook's measured cam, and even tables of known curves, for the tests."""

import numpy as np

import cammotion as cm

INCH_M = 0.0254
SHOWN = (
    "0 .080 .215 .439 .730 1.112 1.500 1.898 2.250 2.561 "
    "2.789 2.949 3.049 3.155 3.410 3.781 4.132 4.422 4.500"
)
HALF = cm.CamTable(
    np.arange(0, 190, 10.0), np.array([*map(float, SHOWN.split())]) * 25.4, step_mm=0.0254
)
CAM = HALF.mirrored()
RATE = 900.0  # a quarter turn a second


def turn(number: int, start: float = 0.0) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return start + np.arange(number) * 360.0 / number
