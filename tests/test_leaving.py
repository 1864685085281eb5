"""The picture of a follower that leaves its cam: what is drawn is what flies."""

import re

import numpy as np
import pytest
from notebook_lint import _svg_faults
from test_animation import parse

import cammotion as cm

LOAD = cm.FollowerLoad(mass_kg=12, stiffness_N_per_mm=1, preload_N=30)
FLIGHTS = cm.follower_flights(cm.EXAMPLE.die, LOAD, 3000)
PICTURE = cm.animate_follower(FLIGHTS)


def frames(part: str) -> tuple[list[float], list[float]]:
    """Return cam angles and the last numbers of what moves a part."""
    (group,) = parse(PICTURE.svg).findall(f".//*[@data-part='{part}']")
    animation = group.find("{*}animateTransform")
    assert animation is not None
    values = [float(v.split()[-1]) for v in animation.attrib["values"].split(";")]
    return [360 * float(time) for time in animation.attrib["keyTimes"].split(";")], values


def test_the_follower_is_drawn_on_its_cam_and_above_it() -> None:
    angles, ways = frames("follower")
    whole = np.array(PICTURE.angle_of(angles))
    lift = cm.EXAMPLE.die.position_mm(whole) + 2 * FLIGHTS.gap_mm(whole)
    lift = lift - lift[0]
    scale = np.max(-np.array(ways)) / lift.max()
    assert -np.array(ways) == pytest.approx(scale * lift, abs=0.05)
    (profile,) = parse(PICTURE.svg).findall(".//*[@data-part='profile']")
    points = np.array([float(n) for n in re.findall(r"-?[0-9.]+", profile.attrib["d"])])
    radii = np.hypot(points[::2], points[1::2])
    assert np.ptp(radii) == pytest.approx(50 * scale, abs=0.3)  # the cam has the same scale


def test_it_says_what_is_to_be_seen() -> None:
    assert not [*_svg_faults(PICTURE.svg)]
    assert (
        "It leaves the cam at 182.9°, by up to 4.29 mm, and hits it at 216.4°"
        in PICTURE.description
    )
    assert "drawn 2 times as large" in PICTURE.svg
    assert PICTURE.svg == cm.animate_follower(FLIGHTS).svg
    assert PICTURE.still(100).description == "At a cam angle of 100° the follower is on the cam."
    assert cm.animate_follower(FLIGHTS, magnify=5).magnify == 5
    slow = cm.animate_follower(cm.follower_flights(cm.EXAMPLE.die, LOAD, 2000))
    assert "It stays on the cam." in slow.description
    assert slow.magnify == 1


def test_the_gap_of_the_still_is_the_gap() -> None:
    gap = FLIGHTS.gap_mm(PICTURE.angle_of(205))
    assert f"{gap:.3g} mm above the cam" in PICTURE.still(205).description


def test_what_is_refused() -> None:
    with pytest.raises(cm.InputError, match="flights=12: give what follower_flights"):
        cm.animate_follower(12)  # type: ignore[arg-type]
    with pytest.raises(cm.InputError, match=r"magnification of the gap is 0\.5"):
        cm.animate_follower(FLIGHTS, magnify=0.5)
    short = cm.follower_flights(cm.EXAMPLE.die, LOAD, 3000, turns=0.5)
    with pytest.raises(cm.InputError, match=r"those of 0\.5 turns"):
        cm.animate_follower(short)
