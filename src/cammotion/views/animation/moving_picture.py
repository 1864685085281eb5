"""What every picture in motion is: an SVG that moves by itself, a file, and a player in the lab."""

from abc import ABC, abstractmethod
from pathlib import Path
from typing import Any

from cammotion.files import ending, write_new
from cammotion.views.animation.player import Player
from cammotion.views.animation.still import as_image


class MovingPicture(ABC):
    """A picture of one turn; as the last line of a cell it is a player."""

    turn_s: float

    @property
    @abstractmethod
    def svg(self) -> str:
        """The SVG, which moves by itself."""

    @property
    @abstractmethod
    def description(self) -> str:
        """What there is to see, in words."""

    @property
    @abstractmethod
    def cycle_s(self) -> float:
        """How long a turn takes in the machine, in s."""

    def save(self, path: str | Path, *, overwrite: bool = False) -> Path:
        """Write the SVG to a file that ends in .svg and return its path.

        A file that is there already is left as it is, with an InputError, unless `overwrite` is
        True.
        """
        ending(path, "picture", [".svg"])
        return write_new(path, self.svg, overwrite=overwrite)

    def player(self) -> Player:
        """Return the SVG with a clock to play, pause and scrub, for the lab."""
        return Player(
            self.svg,
            turn_s=self.turn_s,
            cycle_s=self.cycle_s,
            reader={
                "text/html": as_image(self.svg, self.description),
                "text/plain": self.description,
            },
        )

    def _repr_mimebundle_(self, **kwargs: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        return self.player()._repr_mimebundle_(**kwargs)
