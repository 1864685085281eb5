"""The moving pictures of the README and of the notebooks; run this file to draw them anew.

With it go the fingerprints of other machines in motion, so that no change of a picture is an
accident: look at the pictures before you run this file.
"""

import hashlib
import json
from pathlib import Path

from cam_machine import cam_machine
from machines import RULE, make_diagram
from table_machine import table_machine
from test_animation import MACHINES

import cammotion as cm
from cammotion.views.animation.picture import Animation

IMAGES = Path(__file__).parent.parent / "notebooks" / "images"
PICTURE = IMAGES / "motion.svg"
CAM = IMAGES / "cam.svg"
TABLE = IMAGES / "table.svg"
STILL = IMAGES / "clearance.svg"
STILL_DEG = 135


def animation() -> Animation:
    """Return both designs of the running example in motion."""
    before = make_diagram()
    after = cm.widest_move(before, "die", RULE).diagram
    return cm.animate({"no overlap": before, "with overlap": after}, rules=RULE)


def cam() -> str:
    """Return the running example with the cam that drives its die."""
    return cam_machine(make_diagram(), RULE)


def table() -> str:
    """Return the table of notebook 08, with eight stations, and the torque that it takes."""
    return table_machine(cm.Indexer(38.5, stops=8, time_s=0.75, friction_N_m=10), 150)


def still() -> str:
    """Return the moment of notebook 03 at which the clearance rule is just kept."""
    before = make_diagram()
    rule = cm.ClearanceRule(
        cm.beyond("die", 19), only_while=cm.within("mill", before.offset_mm("mill", STILL_DEG))
    )
    after = cm.widest_move(before, "die", rule).diagram
    return cm.animate(after, rules=rule, magnify=10).still(STILL_DEG).svg


FINGERPRINTS = Path(__file__).parent / "data" / "pictures.json"


def fingerprints() -> dict[str, str]:
    """Return what each picture can be told by, for the machines on which the animation is tried."""
    pictures = {
        str(machine.id): cm.animate(machine.values[0], rules=machine.values[1]).svg
        for machine in MACHINES
    }
    return {name: hashlib.sha256(svg.encode()).hexdigest()[:16] for name, svg in pictures.items()}


if __name__ == "__main__":
    FINGERPRINTS.write_text(json.dumps(fingerprints(), indent=1) + "\n", "utf-8")
    animation().save(PICTURE, overwrite=True)
    CAM.write_text(cam(), "utf-8", newline="")
    TABLE.write_text(table(), "utf-8", newline="")
    STILL.write_text(still(), "utf-8", newline="")
