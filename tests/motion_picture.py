"""The moving picture of the README and of notebook 04; run this file to draw it anew."""

from pathlib import Path

from machines import RULE, make_diagram

import cammotion as cm
from cammotion.views.animation import Animation

PICTURE = Path(__file__).parent.parent / "notebooks" / "images" / "motion.svg"


def animation() -> Animation:
    """Return both designs of the running example in motion."""
    before = make_diagram()
    after = cm.widest_move(before, "die", RULE).diagram
    return cm.animate({"no overlap": before, "with overlap": after}, rules=RULE)


if __name__ == "__main__":
    animation().save(PICTURE, overwrite=True)
