"""Checks of the laws that a machine moves by: values, factors, the way back, heights."""

import numpy as np

from cammotion import MotionLaw
from fresh.drawing import Machine
from fresh.sampling import Array, function_of, joints_of, jumps_at

SAMPLES = 4001
JUMP = 1e-6  # of a curve whose size is about 1


def values(machine: Machine) -> None:
    """Compare S, V, A and J at any place, in any order and shape."""
    for law in machine.laws:
        places = machine.rng.uniform(0, 1, 300)
        places = places[_away(law, places)]
        for order in range(4):
            own = function_of(law, order)(places)
            near = 1e-8 * (1 + np.abs(own).max())
            _same(law(places, order), own, near, f"{law}, derivative {order}")
            ordered = np.argsort(places)
            _same(law(places[ordered], order), own[ordered], near, f"{law}, in order")
            one = law(float(places[0]), order)
            assert isinstance(one, float)
            _same(one, own[0], near, f"{law}, derivative {order}, one place")


def factors(machine: Machine) -> None:
    """Find the peak factors, with a rest before and after; symmetry."""
    for law in machine.laws:
        found = (law.Cv, law.Ca, law.Cj)
        for order, value in enumerate(found, 1):
            jumps = any(_largest_jump(law, lower) > JUMP for lower in range(1, order))
            own = np.inf if jumps else _largest(law, order)
            assert np.isclose(value, own, rtol=1e-4), f"{law}: {value} of order {order}, not {own}"
        inside = _samples(law)
        power = function_of(law, 1)(inside) * function_of(law, 2)(inside)
        assert np.isclose(law.Cq, np.abs(power).max(), rtol=1e-3), f"{law}: Cq"
        s = function_of(law, 0)
        places = np.linspace(0, 1, 101)
        off = float(np.abs(s(places) + s(1 - places) - 1).max())
        assert law.is_symmetric == (off < 1e-9) or 1e-13 < off < 1e-9, f"{law}: symmetry"
        if law.is_symmetric and abs(function_of(law, 1)(np.array(0.5))) > JUMP:
            _check_constant_velocity(law, machine.rng.uniform(0.01, 0.9))


def derived(machine: Machine) -> None:
    """Run a law backwards, and take a part of it."""
    places = machine.rng.uniform(0, 1, 100)
    for law in machine.laws:
        s = function_of(law, 0)
        _same(law.reversed()(places), 1 - s(1 - places), 1e-9, f"{law}, reversed")
        low, high = np.sort(machine.rng.uniform(0, 1, 2))
        first, way = s(np.array(low)), s(np.array(high)) - s(np.array(low))
        if abs(way) > 1e-3 and high - low > 1e-3:
            own = np.asarray((s(low + (high - low) * places) - first) / way)
            name = f"{law}, {low} to {high}"
            _same(law.part(low, high)(places), own, 1e-8 / abs(float(way)), name)


def inverses(machine: Machine) -> None:
    """Go the way back: to the first place at which a height is reached."""
    for law in machine.laws:
        s = function_of(law, 0)
        samples = s(np.linspace(0, 1, SAMPLES))
        falls = float(np.diff(samples).min())
        assert not (law.is_monotone and falls < -1e-9), f"{law} falls"
        assert law.is_monotone or falls < 1e-9, f"{law} does not fall"
        if not law.is_monotone:
            continue
        heights = np.append(machine.rng.uniform(0, 1, 20), [0, 1e-9, 1 - 1e-9, 1])
        places = law.inverse(heights)
        _same(s(places), heights, 1e-9, f"{law}: back and forth")
        low, high = np.zeros(len(heights)), np.ones(len(heights))
        for _ in range(60):
            middle = (low + high) / 2
            is_below = s(middle) < heights
            low, high = np.where(is_below, middle, low), np.where(is_below, high, middle)
        too_late = (places > high + 1e-7) & (np.abs(s(high) - s(places)) > 1e-12)
        assert not np.any(too_late), f"{law}: {heights[too_late]} is reached before"


def heights(machine: Machine) -> None:
    """Find where a law is above a height, and below it."""
    for law in machine.laws:
        s = function_of(law, 0)
        places = np.append(_samples(law), machine.rng.uniform(0, 1, 200))
        own = s(places)
        for height in (*machine.rng.uniform(-0.3, 1.3, 6), 0.0, 1.0):
            for side, found in ((1, law.where_above(height)), (-1, law.where_below(height))):
                there = np.any([(a < places) & (places < b) for a, b in [*found, (2, 2)]], axis=0)
                beyond = side * (own - height)
                assert not np.any(there & (beyond < -1e-9)), f"{law}, {height}, side {side}"
                assert not np.any(~there & (beyond > 1e-9)), f"{law}, {height}, side {side}"
                assert found == sorted(found)


def _check_constant_velocity(law: MotionLaw, share: float) -> None:
    """Its middle is straight, and before it the law is its own first half, made smaller."""
    slowed = law.with_constant_velocity(share)
    end = (1 - share) / 2
    middle = slowed(np.linspace(end + 1e-6, 1 - end - 1e-6, 9), 1)
    velocity = float(middle[0])
    _same(middle, velocity, 1e-6 * abs(velocity), f"{slowed}: its middle")
    steepest = function_of(law, 1)(np.array([0.5]))[0]
    first = np.linspace(0, 1, 33)[:-1]
    scale = velocity * (1 - share) / steepest
    _same(slowed(first * end), scale * function_of(law, 0)(first / 2), 1e-9, f"{slowed}: its start")
    _same(slowed(np.array([0, 0.5, 1])), np.array([0, 0.5, 1]), 1e-9, f"{slowed}: its ends")


def _samples(law: MotionLaw) -> Array:
    """Return places over the law, and both sides of its joints and ends."""
    near = [place + way for place in (0, *joints_of(law), 1) for way in (-1e-9, 1e-9)]
    places = np.concatenate([np.linspace(0, 1, SAMPLES)[1:-1], near])
    return np.asarray(np.sort(places[(places > 0) & (places < 1)]))


def _largest(law: MotionLaw, order: int) -> float:
    """Return the largest magnitude of a curve, refined between samples."""
    places, curve = _samples(law), function_of(law, order)
    most = np.abs(curve(places))
    place = places[np.argmax(most)]
    near = np.clip(place + np.linspace(-1, 1, 201) / SAMPLES, places[0], places[-1])
    near = near[_away(law, near)] if joints_of(law) else near
    return float(max(most.max(), np.abs(curve(near)).max(initial=0)))


def _largest_jump(law: MotionLaw, order: int) -> float:
    curve = function_of(law, order)
    ends = np.abs(curve(np.array([0.0, 1.0])))
    inside = np.abs(jumps_at(curve, joints_of(law), 1e-7))
    return float(max(np.max(ends), np.max(inside, initial=0)))


def _away(law: MotionLaw, places: Array) -> Array:
    joints = np.array([2.0, *joints_of(law)])
    return np.asarray(np.abs(places[:, None] - joints).min(axis=1) > 1e-8)


def _same(found: object, own: object, within: float, what: str) -> None:
    off = np.abs(np.subtract(found, own))  # type: ignore[call-overload]
    assert np.all(off <= within), f"{what}: {off.max()} off, and {within} is allowed"
