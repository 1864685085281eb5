"""The picture of a table in motion: it turns by one station a cycle, and the torque is its own."""

import math
from pathlib import Path
from xml.etree import ElementTree

import motion_picture
import numpy as np
import pytest
from notebook_lint import _svg_faults
from table_machine import table_machine

import cammotion as cm

TABLE = cm.Indexer(38.5, stops=8, time_s=0.75, friction_N_m=10)
SVG = "{http://www.w3.org/2000/svg}"
ROOT = ElementTree.fromstring(table_machine(TABLE, 150))  # noqa: S314 - our own


def values_of(kind: str, number: int = 0) -> np.ndarray:
    """Return the values of an animation, row by row."""
    found = [a for a in ROOT.iter(f"{SVG}animateTransform") if a.attrib["type"] == kind][number]
    return np.array(
        [[float(n) for n in each.split()] for each in found.attrib["values"].split(";")]
    )


def test_the_picture_of_notebook_08_is_the_table_of_the_example() -> None:
    """If not, tests/motion_picture.py draws it anew."""
    assert motion_picture.TABLE.read_text("utf-8") == motion_picture.table()
    assert motion_picture.TABLE.parent == Path(__file__).parent.parent / "notebooks" / "images"


def test_it_is_complete() -> None:
    assert list(_svg_faults(table_machine(TABLE, 150))) == []
    texts = [text.text for text in ROOT.iter(f"{SVG}text")]
    assert {"307", "−287", "the table pushes the drive"} <= {*texts}
    assert len([*ROOT.iter(f"{SVG}circle")]) == 1 + 8 + 1 + 1  # table, stations, hub, point


def test_the_table_turns_by_one_station_and_follows_the_law() -> None:
    turned = values_of("rotate")[:, 0]
    assert turned[-1] - turned[0] == pytest.approx(45, abs=0.01)
    middle = turned[60]  # of 121 samples over the index
    assert middle == pytest.approx(22.5, abs=0.4)


def test_the_point_runs_along_the_torque() -> None:
    heights = -values_of("translate", 1)[:, 1]
    assert heights.max() - heights[0] == pytest.approx(
        110 * (1 - 10 / TABLE.peak_torque_N_m), rel=1e-3
    )


def test_an_index_of_a_whole_turn_and_one_that_is_none() -> None:
    assert "the table stands" not in table_machine(TABLE, 360)
    with pytest.raises(cm.InputError, match="indexing angle is 0 deg"):
        table_machine(TABLE, 0)
    assert math.isfinite(TABLE.peak_torque_N_m)
