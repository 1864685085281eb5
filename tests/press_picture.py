"""The moving picture of notebook 12: run this file to draw it anew."""

from pathlib import Path

import cammotion as cm

NOTEBOOKS = Path(__file__).parent.parent / "notebooks"
PICTURE = NOTEBOOKS / "images" / "press.svg"


def drawn() -> str:
    """Return the picture: the press of eight mechanisms in motion."""
    pads = cm.read_machine(NOTEBOOKS / "data" / "pad_press.csv")
    return cm.animate(pads.diagram, rules=pads.rules).svg


if __name__ == "__main__":
    PICTURE.write_text(drawn(), "utf-8", newline="")
