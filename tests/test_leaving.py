"""The picture of a follower that leaves its cam: what is drawn is what flies."""

import re

import numpy as np
import pytest
from notebook_lint import _svg_faults
from test_animation import parse

import cammotion as cm
from cammotion.views.animation.leaving import _Picture

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


FAR = {  # stiffness, turns: what is said of the last turn, and the angles over which it flies
    (0.01, 4): (
        "It comes into the turn in the air, and hits the cam at 26.2° with 0.37 m/s.",
        236.2,
    ),
    (0.01, 3): ("It leaves the cam at 177.7°, by up to 318 mm, and lands in a later turn.", 332.3),
    (0.01, 1.5): ("It is in the air all the turn, and does not come back to the cam in it.", 360),
    (0.05, 3): (
        "It leaves the cam at 177.9°, by up to 145 mm, and hits it at 90.4° with 0.373 m/s.",
        272.5,
    ),
}


@pytest.mark.parametrize(("stiffness", "turns"), FAR)
def test_a_flight_may_be_longer_than_the_turn_that_is_shown(stiffness: float, turns: float) -> None:
    """A soft spring brings it back two turns later: it was said to stay on the cam."""
    load = cm.FollowerLoad(mass_kg=12, stiffness_N_per_mm=stiffness, preload_N=1)
    found = cm.follower_flights(cm.EXAMPLE.die, load, 2000, turns=turns)
    picture = cm.animate_follower(found)
    said, flies_deg = FAR[stiffness, turns]
    assert picture.description.splitlines()[1] == said
    assert "It stays on the cam" not in picture.description
    assert not [*_svg_faults(picture.svg)]
    angles = np.arange(0.05, 360, 0.1)
    assert 0.1 * np.sum(found.gap_mm(picture.angle_of(angles)) > 0) == pytest.approx(
        flies_deg, abs=1
    )
    air = _Picture(picture)._air
    assert sum(end - start for start, end in air) == pytest.approx(flies_deg, abs=1)


def test_turns_in_one_long_flight_are_none_that_come_again() -> None:
    load = cm.FollowerLoad(mass_kg=20_000, stiffness_N_per_mm=0.01, preload_N=10)
    found = cm.follower_flights(cm.EXAMPLE.die, load, 2000, turns=4)
    assert len(found) == 1
    assert found.period is None
    assert "the turn before was another" in cm.animate_follower(found).svg
    on_cam = cm.follower_flights(cm.EXAMPLE.die, LOAD, 1000, turns=4)
    assert (len(on_cam), on_cam.period) == (0, 1)


def test_what_is_said_of_the_turn_before_stands_over_the_heading_of_the_chart() -> None:
    load = cm.FollowerLoad(mass_kg=12, stiffness_N_per_mm=0.01, preload_N=1)
    drawing = parse(cm.animate_follower(cm.follower_flights(cm.EXAMPLE.die, load, 2000)).svg)
    over = {part: each for each in drawing.iter() for part in each}

    def left(words: str) -> float:
        (text,) = [part for part in over if (part.text or "").startswith(words)]
        x, part = float(text.attrib["x"]), over[text]
        while part in over:
            moved = re.match(r"translate\(([\d.]+)", part.attrib.get("transform", ""))
            x, part = x + float(moved[1] if moved else 0), over[part]
        return x

    assert left("the turn before was another") == left("displacement in mm")


def test_the_gap_of_the_still_is_the_gap() -> None:
    gap = FLIGHTS.gap_mm(PICTURE.angle_of(205))
    assert f"{gap:.3g} mm above the cam" in PICTURE.still(205).description


@pytest.mark.parametrize(("rate", "magnify"), [(6000, None), (12_000, None), (3000, 50)])
def test_a_follower_that_flies_far_stays_in_the_picture(rate: float, magnify: float | None) -> None:
    flights = cm.follower_flights(cm.EXAMPLE.die, LOAD, rate)
    picture = cm.animate_follower(flights, magnify=magnify)
    (body,) = parse(picture.svg).findall(".//*[@data-part='follower']/..")
    (moving,) = body.findall("*")
    animation = moving.find("{*}animateTransform")
    assert animation is not None
    ways = [float(value.split()[-1]) for value in animation.attrib["values"].split(";")]
    at = float(body.attrib["transform"].rstrip(")").split()[-1])
    assert at + min(ways) - 52 > 54  # its upper end is under what is written above
    assert at + max(ways) < 300  # and its roller above the camshaft


def test_what_is_refused() -> None:
    with pytest.raises(cm.InputError, match="flights=12: give what follower_flights"):
        cm.animate_follower(12)  # type: ignore[arg-type]
    with pytest.raises(cm.InputError, match=r"magnification of the gap is 0\.5"):
        cm.animate_follower(FLIGHTS, magnify=0.5)
    short = cm.follower_flights(cm.EXAMPLE.die, LOAD, 3000, turns=0.5)
    with pytest.raises(cm.InputError, match=r"those of 0\.5 turns"):
        cm.animate_follower(short)
