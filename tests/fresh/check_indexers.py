"""Checks of an indexer whose law is any: torque, power, heat and impact, among samples."""

import numpy as np

import cammotion as cm
from fresh.drawing import Machine
from fresh.sampling import function_of, joints_of, jumps_at

FINE = 200_001
JUMP = 1e-9


def indexers(machine: Machine) -> None:
    """Size a table for each law of the machine."""
    for law in machine.laws:
        velocity = function_of(law, 1)
        places = [0.0, *joints_of(law), 1.0]
        if np.any(np.abs(jumps_at(velocity, np.array(places[1:-1]), 1e-9)) > JUMP):
            continue
        if max(abs(float(velocity(np.array(end)))) for end in (0.0, 1.0)) > JUMP:
            continue
        _check(law, machine.rng)


def _check(law: cm.MotionLaw, rng: np.random.Generator) -> None:
    inertia, stops = rng.uniform(0.1, 100), int(rng.integers(2, 40))
    time, friction = rng.uniform(0.05, 3), rng.choice([0.0, 1.0, 20.0])
    table = cm.Indexer(inertia, stops, time, law, friction_N_m=friction)
    inside = np.linspace(0, 1, FINE)[1:-1]
    step = 2 * np.pi / stops
    omega = step / time * function_of(law, 1)(inside)
    dragged = np.where(omega < 0, -friction, friction)
    torque = inertia * step / time**2 * function_of(law, 2)(inside) + dragged
    power = torque * omega
    for own, said, what in (
        (float(np.abs(torque).max()), table.peak_torque_N_m, "torque"),
        (float(np.abs(power).max()), table.peak_power_W, "power"),
        (float(inertia * omega.max() ** 2 / 2), table.kinetic_energy_J, "energy"),
        (float(np.sqrt(np.mean(torque**2) / 2)), table.rms_torque_N_m(2 * time), "rms torque"),
    ):
        assert abs(said - own) < 2e-3 * own, f"{law}: {what} {said}, not {own}"
