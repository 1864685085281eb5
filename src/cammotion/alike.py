"""Things that are equal by what they are made of, and can be sent to another process."""

from types import FunctionType
from typing import Any

import numpy as np


class Alike:
    """What equals all that is of its class and made of the same; `made_of` names its attributes."""

    made_of: tuple[str, ...] = ()

    @property
    def _key(self) -> tuple[Any, ...]:
        parts = (getattr(self, name) for name in self.made_of)
        same = (part.tobytes() if isinstance(part, np.ndarray) else part for part in parts)
        return (type(self), *same)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Alike) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)

    def __getstate__(self) -> dict[str, Any]:
        """Return what another process needs; functions it makes anew."""
        return {name: it for name, it in vars(self).items() if not isinstance(it, FunctionType)}
