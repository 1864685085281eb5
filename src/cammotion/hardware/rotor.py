"""All that turns about one axis: the parts together, as a table and as one number."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from cammotion.alike import Alike
from cammotion.hardware.inertia import Cross, Cuboid, Disc, OwnInertia, PointMasses, Ring
from cammotion.machine.kinematics import MM_PER_M, STANDARD_GRAVITY
from cammotion.quantities import InputError, Quantity, decimals_of, shorten

_GRAVITY = Quantity("acceleration of gravity", "m/s2", example=9.81)
_KINDS = (Disc, Ring, Cuboid, Cross, PointMasses, OwnInertia)


@dataclass(frozen=True, eq=False)
class Rotor(Alike):
    """All that turns, part by part: `parts` has a name for each.

    Raises InputError for no parts at all, and for what is no part.

    >>> table = Rotor({
    ...     "dial plate": Disc(radius_mm=500, mass_kg=43.04),
    ...     "stations": PointMasses(each_kg=20, radius_mm=450, count=8),
    ... })
    >>> print(table)
    part        mass in kg  inertia in kg m²
    dial plate      43.040             5.380
    stations       160.000            32.400
    together       203.040            37.780
    """

    parts: Mapping[str, Disc | Ring | Cuboid | Cross | PointMasses | OwnInertia]

    def __post_init__(self) -> None:
        if not isinstance(self.parts, Mapping) or not self.parts:
            raise InputError(
                f"The parts are {shorten(self.parts)}: give each a name, for example "
                '{"plate": cammotion.Disc(radius_mm=500, mass_kg=43.04)}.'
            )
        for name, part in self.parts.items():
            if not isinstance(part, _KINDS):
                known = ", ".join(kind.__name__ for kind in _KINDS)
                raise InputError(
                    f"The part {shorten(name)} is {shorten(part)}; there are the kinds {known}: "
                    "give for example cammotion.Disc(radius_mm=500, mass_kg=43.04)."
                )
        object.__setattr__(self, "parts", MappingProxyType(dict(self.parts)))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self.parts),)

    @property
    def mass_kg(self) -> float:
        """The mass of all parts, in kg."""
        return math.fsum(part.mass_kg for part in self.parts.values())

    @property
    def inertia_kg_m2(self) -> float:
        """The moment of inertia of all parts about the axis, in kg m2."""
        return math.fsum(part.inertia_kg_m2 for part in self.parts.values())

    @property
    def radius_of_gyration_mm(self) -> float:
        """The radius on which the whole mass would have the same inertia, in mm."""
        return math.sqrt(self.inertia_kg_m2 / self.mass_kg) * MM_PER_M

    def gd2_N_m2(self, gravity_m_per_s2: float = STANDARD_GRAVITY) -> float:  # noqa: N802 (units)
        """Return GD2 = 4 g I in N m2: the weight times the square of the diameter of gyration.

        `gravity_m_per_s2` is the standard one if it is not given.

        >>> table = Rotor({"all": OwnInertia(mass_kg=211.04, inertia_kg_m2=38.5)})
        >>> print(f"{table.gd2_N_m2():.1f} N m2, {table.gd2_N_m2(9.81):.1f} N m2")
        1510.2 N m2, 1510.7 N m2
        """
        return 4 * _GRAVITY.number(gravity_m_per_s2) * self.inertia_kg_m2

    def __repr__(self) -> str:
        parts = shorten(", ".join(map(str, self.parts)), of=str)
        return f"Rotor({parts}: {self.inertia_kg_m2:.4g} kg m²)"

    def __str__(self) -> str:
        rows = [(str(name), part.mass_kg, part.inertia_kg_m2) for name, part in self.parts.items()]
        rows.append(("together", self.mass_kg, self.inertia_kg_m2))
        wide = max(len(name) for name, _, _ in rows)
        head = f"{'part':{wide}}  mass in kg  inertia in kg m²"
        m_digits, i_digits = (decimals_of(total, 3) for total in rows[-1][1:])
        lines = (f"{n:{wide}}  {m:10.{m_digits}f}  {i:16.{i_digits}f}" for n, m, i in rows)
        return "\n".join([head, *lines])
