"""The parts of what turns, and the inertia of each about the axis.

The axis goes through the centre of each part, upright on it; what stands beside the axis is a
point mass on a radius, with an inertia of its own if it has one. A body is given by its mass, or
by its thickness along the axis and its density. Lengths are in mm, masses in kg, inertias in kg m2.
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, fields

from cammotion.machine.kinematics import MM_PER_M
from cammotion.quantities import InputError, Quantity, keep_numbers

_MASS = Quantity("mass", "kg", example=20)
_RADIUS = Quantity("radius", "mm", example=450)
_INNER = Quantity("inner radius", "mm", example=100)
_LENGTH = Quantity("length", "mm", example=300)
_WIDTH = Quantity("width", "mm", example=25)
_THICKNESS = Quantity("thickness", "mm", example=10)
_DENSITY = Quantity("density", "kg/m3", example=7850)
_WEIGHED = ("mass_kg", "thickness_mm", "density_kg_per_m3")
_COUNT = Quantity("number of masses", "", example=8, low=1, low_included=True)
_INERTIA = Quantity("inertia", "kg m2", example=5.38, low_included=True)


class _Reckoned(float):
    """A mass that follows from thickness and density."""


@dataclass(frozen=True, kw_only=True, repr=False)
class _Body(ABC):
    """A flat body about its own axis: its area, and its square of gyration.

    Each kind adds these two. `mass_kg` is filled in where thickness and density were given, as a
    number that knows so: a copy with other sizes, by dataclasses.replace, reckons it anew.
    """

    mass_kg: float = None  # type: ignore[assignment]  # filled in
    thickness_mm: float | None = None
    density_kg_per_m3: float | None = None

    def __post_init__(self) -> None:
        self._read_sizes()
        has_mass, has_thickness, has_density = (
            way is not None for way in (self.mass_kg, self.thickness_mm, self.density_kg_per_m3)
        )
        by_density = has_thickness and has_density
        by_mass = has_mass and not (by_density and isinstance(self.mass_kg, _Reckoned))
        if by_mass == by_density or has_thickness != has_density:
            kind = type(self).__name__
            raise InputError(
                f"A {kind} is weighed in one way: give its mass_kg, or its thickness_mm and its "
                "density_kg_per_m3, for example 10 mm and 7850 kg/m3."
            )
        if by_mass:
            keep_numbers(self, mass_kg=_MASS.number)
            return
        thickness = _THICKNESS.number(self.thickness_mm)
        density = _DENSITY.number(self.density_kg_per_m3)
        mass = _Reckoned(self._area_m2 * _m(thickness) * density)
        for name, value in zip(_WEIGHED, (mass, thickness, density), strict=True):
            object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        """Return it as it was made: a mass that was reckoned is not given."""
        given = {each.name: getattr(self, each.name) for each in fields(self)}
        if isinstance(self.mass_kg, _Reckoned):
            given["mass_kg"] = None
        return f"{type(self).__name__}({', '.join(f'{n}={v!r}' for n, v in given.items())})"

    @property
    def inertia_kg_m2(self) -> float:
        """The moment of inertia about the axis, in kg m2."""
        return self.mass_kg * self._gyration_m2

    @abstractmethod
    def _read_sizes(self) -> None:
        """Raise InputError for sizes that make no sense."""

    @property
    @abstractmethod
    def _area_m2(self) -> float:
        """The area of the plate."""

    @property
    @abstractmethod
    def _gyration_m2(self) -> float:
        """The square of the radius of gyration."""


@dataclass(frozen=True, kw_only=True, repr=False)
class Disc(_Body):
    """A round plate of a radius in mm: m r^2 / 2.

    Give its mass_kg, or its thickness_mm and its density_kg_per_m3. Raises InputError for others.

    >>> print(f"{Disc(radius_mm=500, mass_kg=43.04).inertia_kg_m2:.3f} kg m2")
    5.380 kg m2
    >>> print(f"{Disc(radius_mm=100, thickness_mm=10, density_kg_per_m3=7800).mass_kg:.2f} kg")
    2.45 kg
    """

    radius_mm: float

    def _read_sizes(self) -> None:
        keep_numbers(self, radius_mm=_RADIUS.number)

    @property
    def _area_m2(self) -> float:
        return math.pi * _m(self.radius_mm) ** 2

    @property
    def _gyration_m2(self) -> float:
        return _m(self.radius_mm) ** 2 / 2


@dataclass(frozen=True, kw_only=True, repr=False)
class Ring(_Body):
    """A round plate with a round hole, radii in mm: m (r_outer^2 + r_inner^2) / 2.

    Give its mass_kg, or its thickness_mm and its density_kg_per_m3. Raises InputError for others,
    and for a hole that is as large as the plate.

    >>> print(f"{Ring(radius_mm=500, inner_mm=400, mass_kg=10).inertia_kg_m2:.3f} kg m2")
    2.050 kg m2
    """

    radius_mm: float
    inner_mm: float

    def _read_sizes(self) -> None:
        keep_numbers(self, radius_mm=_RADIUS.number, inner_mm=_INNER.number)
        outer, inner = self.radius_mm, self.inner_mm
        if inner >= outer:
            raise InputError(
                f"The inner radius is {inner:g} mm and the outer one {outer:g} mm: give an inner "
                f"one that is smaller, for example {outer / 2:g} mm."
            )

    @property
    def _area_m2(self) -> float:
        return math.pi * (_m(self.radius_mm) ** 2 - _m(self.inner_mm) ** 2)

    @property
    def _gyration_m2(self) -> float:
        return (_m(self.radius_mm) ** 2 + _m(self.inner_mm) ** 2) / 2


@dataclass(frozen=True, kw_only=True, repr=False)
class Cuboid(_Body):
    """A bar of a length and a width in mm, which turns about its middle: m (l^2 + w^2) / 12.

    Give its mass_kg, or its thickness_mm and its density_kg_per_m3. Raises InputError for others.

    >>> print(f"{Cuboid(length_mm=1200, width_mm=0.1, mass_kg=1).inertia_kg_m2:.4f} kg m2")
    0.1200 kg m2
    """

    length_mm: float
    width_mm: float

    def _read_sizes(self) -> None:
        keep_numbers(self, length_mm=_LENGTH.number, width_mm=_WIDTH.number)

    @property
    def _area_m2(self) -> float:
        return _m(self.length_mm) * _m(self.width_mm)

    @property
    def _gyration_m2(self) -> float:
        return (_m(self.length_mm) ** 2 + _m(self.width_mm) ** 2) / 12


@dataclass(frozen=True, kw_only=True, repr=False)
class Cross(_Body):
    """Two equal bars that cross in the middle, length and width in mm.

    The square in which they cross is there once, so it is taken away once. Give the mass_kg of the
    whole cross, or its thickness_mm and its density_kg_per_m3. Raises InputError for others, and
    for bars that are wider than long.

    >>> cross = Cross(length_mm=300, width_mm=25, thickness_mm=10, density_kg_per_m3=7800)
    >>> print(f"{cross.mass_kg:.3f} kg, {cross.inertia_kg_m2 * 1e4:.2f} kg cm2")
    1.121 kg, 88.31 kg cm2
    """

    length_mm: float
    width_mm: float

    def _read_sizes(self) -> None:
        keep_numbers(self, length_mm=_LENGTH.number, width_mm=_WIDTH.number)
        length, width = self.length_mm, self.width_mm
        if width >= length:
            raise InputError(
                f"The bars of the cross are {length:g} mm long and {width:g} mm wide: give a width "
                f"below the length, for example {length / 10:g} mm."
            )

    @property
    def _area_m2(self) -> float:
        length, width = _m(self.length_mm), _m(self.width_mm)
        return 2 * length * width - width**2

    @property
    def _gyration_m2(self) -> float:
        length, width = _m(self.length_mm), _m(self.width_mm)
        bar, square = length * width * (length**2 + width**2) / 12, width**4 / 6
        return (2 * bar - square) / self._area_m2


@dataclass(frozen=True, kw_only=True)
class PointMasses:
    """Equal masses on a radius in mm: count (m r^2 + own).

    `each_kg` is the mass of one of them, `own_kg_m2` its inertia about its own upright axis, which
    is left out for what is small beside the radius. Raises InputError for what makes no sense.

    >>> stations = PointMasses(each_kg=20, radius_mm=450, count=8)
    >>> print(f"{stations.mass_kg:g} kg, {stations.inertia_kg_m2:.3f} kg m2")
    160 kg, 32.400 kg m2
    """

    each_kg: float
    radius_mm: float
    count: int = 1
    own_kg_m2: float = 0.0

    def __post_init__(self) -> None:
        keep_numbers(
            self,
            each_kg=_MASS.number,
            radius_mm=_RADIUS.number,
            own_kg_m2=_INERTIA.number,
            count=_COUNT.whole,
        )

    @property
    def mass_kg(self) -> float:
        """The mass of all of them, in kg."""
        return self.count * self.each_kg

    @property
    def inertia_kg_m2(self) -> float:
        """Their moment of inertia about the axis of the table, in kg m2."""
        return self.count * (self.each_kg * _m(self.radius_mm) ** 2 + self.own_kg_m2)


@dataclass(frozen=True, kw_only=True)
class OwnInertia:
    """A part whose mass in kg and inertia in kg m2 are known, from a drawing or a catalogue.

    >>> OwnInertia(mass_kg=8, inertia_kg_m2=0.72).inertia_kg_m2
    0.72
    """

    mass_kg: float
    inertia_kg_m2: float

    def __post_init__(self) -> None:
        keep_numbers(self, mass_kg=_MASS.number, inertia_kg_m2=_INERTIA.number)


def _m(length_mm: float) -> float:
    return length_mm / MM_PER_M
