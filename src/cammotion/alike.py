"""Things that are equal by what they are made of, and can be sent to another process."""

from collections.abc import Mapping
from dataclasses import fields
from types import FunctionType
from typing import Any

import numpy as np


class Alike:
    """What equals all that is of its class and made of the same.

    `made_of` names its attributes; of a dataclass without them it is its fields.
    """

    made_of: tuple[str, ...] = ()

    @property
    def _key(self) -> tuple[Any, ...]:
        kind: Any = self
        names = self.made_of or [each.name for each in fields(kind) if each.compare]
        return (type(self), *(_comparable(getattr(self, name)) for name in names))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Alike) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)

    def __getstate__(self) -> dict[str, Any]:
        """Return what another process needs; functions it makes anew."""
        return {name: it for name, it in vars(self).items() if not isinstance(it, FunctionType)}


def _comparable(part: Any) -> Any:
    if isinstance(part, np.ndarray):
        return part.shape, part.tobytes()
    return frozenset(part.items()) if isinstance(part, Mapping) else part
