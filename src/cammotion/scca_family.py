"""The SCCA family: sine - constant - cosine acceleration, five of the named laws among it."""

import sympy

from cammotion.checks import InputError, Quantity
from cammotion.motion_law import MotionLaw, exact, mirrored
from cammotion.zones import Zone, x

_PART = Quantity("zone of the SCCA law", "", example=0.25, high=1.0, low_included=True)
_ROUNDING = 1e-9
_pi = sympy.pi


def scca(
    b: float, c: float, d: float, *, name: str = "", also_called: tuple[str, ...] = ()
) -> MotionLaw:
    """Return a law of the family sine - constant - cosine acceleration.

    The acceleration rises as a sine over b/2 of the time, is constant over c/2 and falls as a
    cosine over d/2, to the middle; the second half mirrors the first. b, c and d are dimensionless,
    from 0 to 1, and add up to 1. With b = 0 or d = 0 that zone is left out, and the acceleration
    jumps there. Raises InputError for others.

    >>> print(f"{scca(0.25, 0.5, 0.25).Ca:.5f}")  # 8 pi / (2 + pi)
    4.88812
    """
    parts = [exact(_PART.number(part)) for part in (b, c, d)]
    if abs(sum(parts) - 1) > _ROUNDING:
        raise InputError(
            f"The zones of the SCCA law, {b:g} + {c:g} + {d:g}, add up to {float(sum(parts)):g}: "
            "let b, c and d add up to 1."
        )
    b_, c_ = parts[0], parts[1]
    d_ = 1 - b_ - c_
    peak = 4 * _pi**2 / ((_pi**2 - 8) * (b_**2 - d_**2) - 2 * _pi * (_pi - 2) * b_ + _pi**2)
    first, second = b_ / 2, (b_ + c_) / 2  # where the zones end
    v_1, s_1 = peak * b_ / _pi, peak * b_ / _pi * (b_ / 2 - b_ / _pi)
    v_2 = v_1 + peak * c_ / 2
    s_2 = s_1 + v_1 * c_ / 2 + peak * c_**2 / 8
    zones = []
    if b_:
        sine = peak * b_ / _pi * (x - b_ / _pi * sympy.sin(_pi * x / b_))
        zones.append(Zone(sine, 0.0, float(first)))
    if c_:
        u = x - first
        zones.append(Zone(s_1 + v_1 * u + peak * u**2 / 2, float(first), float(second)))
    if d_:
        w = x - second
        cosine = s_2 + v_2 * w + peak * (d_ / _pi) ** 2 * (1 - sympy.cos(_pi * w / d_))
        zones.append(Zone(cosine, float(second), 0.5))
    return MotionLaw(name or f"SCCA({b:g}, {c:g}, {d:g})", mirrored(zones), also_called)
