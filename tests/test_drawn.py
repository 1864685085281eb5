"""Each kind of picture is drawn as its account says: no change of one is an accident."""

import re
from pathlib import Path

import drawn
import matplotlib as mpl
import pytest
from accounts import Account, account, differences
from drawn import KEPT, PICTURES, answers, file_of
from environments import ROOT

import cammotion as cm

SOURCE = Path(drawn.__file__)
each_picture = pytest.mark.parametrize("name", PICTURES)
HOW = "Look at the picture. If it is meant to change, run tests/drawn.py and read what changed."

PINNED = re.findall(r"^matplotlib==(\S+)", (ROOT / "environment.txt").read_text("utf-8"), re.M)
by_the_pinned = pytest.mark.skipif(
    [mpl.__version__] != PINNED, reason="NOT TESTED: another Matplotlib draws some places otherwise"
)


def kept(name: str) -> Account:
    """Return the account that is kept of a picture."""
    return file_of(name).read_text("utf-8").splitlines()


@by_the_pinned
@each_picture
def test_a_picture_is_as_its_account_says(name: str) -> None:
    changed = differences(kept(name), account(PICTURES[name]()))
    assert not changed, f"{HOW}\n{changed}"


def test_what_wrong_answers_show_is_as_its_account_says() -> None:
    changed = differences(kept("answers"), answers())
    assert not changed, f"{HOW}\n{changed}"


def test_every_function_that_draws_has_an_account() -> None:
    drawing = [name for name in cm.__all__ if name.startswith(("plot_", "animate", "explore_"))]
    source = SOURCE.read_text("utf-8")
    assert not [name for name in drawing if f"cm.{name}(" not in source]


def test_nothing_is_kept_of_pictures_that_are_no_more() -> None:
    assert {*KEPT.glob("*")} == {file_of(name) for name in (*PICTURES, "answers")}
