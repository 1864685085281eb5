"""What is rounding of a torque: where the torques of a shaft cancel, or there are none."""

from cammotion.drive.camshaft import Camshaft

_SHARE = 1e-9  # of what a mechanism asks by itself


def torque_rounding(shaft: Camshaft) -> float:
    """Return a torque in N m that is none, beside what the largest forces ask at full velocity."""
    asked = (
        abs(shaft.peak_force(name).value) * shaft.diagram.peak_velocity(name)
        for name in shaft.loads
    )
    return _SHARE * max(asked, default=0.0) / shaft.speed_rad_per_s
