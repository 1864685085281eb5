"""What a disc cam costs, how large its file is, and how far off another package's profile is."""

import importlib
import sys
import tempfile
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
from findings import Finding, ratio_of_medians, say
from package import time_by_turns

import cammotion as cm

MS, KB = 1000, 1000
ROUNDS, POINTS = 15, 3600
STROKE_MM, PRIME_MM, ROLLER_MM = 50, 70, 10
ROLLER = cm.TranslatingRoller(ROLLER_MM)


def measure_cams() -> list[Finding]:
    """Profile, pressure angle and curvature of the die's cam, smallest prime circle, DXF."""
    die = cm.EXAMPLE.die
    cam = cm.RollerCam(die, ROLLER, cm.smallest_prime_radius(die, ROLLER))
    at = np.linspace(0, 360, POINTS, endpoint=False)
    drawn, sized = time_by_turns(
        lambda: (cam.profile_mm(at), cam.pressure_angle_deg(at), cam.profile_radius_mm(at)),
        lambda: cm.smallest_prime_radius(die, ROLLER),
        ROUNDS,
    )
    with tempfile.TemporaryDirectory() as folder:
        size = cm.write_cam(cam, Path(folder) / "die.dxf").stat().st_size
    what = f"profile, pressure angle and curvature at {POINTS} points"
    return [
        Finding(what, MS * median(drawn), 10, "ms"),
        Finding("smallest prime circle for 30 deg", MS * median(sized), 50, "ms"),
        Finding("DXF of the die's cam, to 0.001 mm", size / KB, 300, "kB"),
    ]


def measure_rival_cams() -> list[Finding]:
    """Compute the profile of a roller's cam, and the same with the package `mechanism`."""
    try:
        cams = importlib.import_module("mechanism.cams")
    except ModuleNotFoundError:
        sys.exit("Only this measure needs another package: python -m pip install -e '.[benchmark]'")
    parts = [("Rise", STROKE_MM, 55), ("Dwell", 100), ("Fall", STROKE_MM, 55), ("Dwell", 150)]
    there = cams.Cam(parts, degrees=True, omega=1, rotation="cw", h=2 * np.pi / POINTS)
    motion = cm.motion(
        "follower",
        *(cm.rise(STROKE_MM, over_deg=55), cm.dwell(100)),
        *(cm.return_(STROKE_MM, over_deg=55), cm.dwell(150)),
    )
    cam = cm.RollerCam(motion, ROLLER, PRIME_MM)
    at = there.thetas_d

    def compute_there() -> Any:
        made = cams.Cycloidal(
            there.motion, there.shifts, there.intervals, there.conditions, there.thetas, omega=1
        )
        return made.get_profile(PRIME_MM - ROLLER_MM, there.thetas)

    exact = cam.profile_mm(np.linspace(0, 360, 36_000)) @ [1, 1j]
    x, y = compute_there()
    turned = (x + 1j * y) * 1j  # 0 deg lies on the axis of x there
    off = max(float(np.abs(point - exact).min()) for point in turned)
    own, rival = time_by_turns(lambda: cam.profile_mm(at), compute_there, ROUNDS)
    say(f"{MS * median(own):.2f} ms and there {MS * median(rival):.2f} ms")
    say(f"there the profile of a roller of {ROLLER_MM} mm is up to {off:.2f} mm off the envelope")
    return [Finding("profile : with `mechanism`", ratio_of_medians(own, rival), 1, "x")]
