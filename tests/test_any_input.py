"""A result or an InputError, whatever is given to a public name; none takes more than seconds."""

import contextlib
import io
import time
import traceback
import warnings

import numpy as np
import pytest
from any_input import ODD, Recorded, recorded
from matplotlib import pyplot as plt

import cammotion as cm

SEED, SECONDS = 20261127, 30
SLOWEST_S = 20
APART = {"again", "ask", "check", "check_setup", "choose", "hint", "predict", "progress", "variant"}
"""What speaks to the learner has a test of its own, test_exercises_fuzz.py."""


@pytest.fixture(scope="module")
def calls() -> list[Recorded]:
    return [call for call in recorded() if call.name not in APART]


def wrong(call: Recorded, parameter: str, value: object) -> str:
    """Make a call with an odd value, and return what is wrong with what came of it."""
    begun = time.perf_counter()
    try:
        with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", message="The points of the law")
            repr(call.with_value(parameter, value))
    except cm.InputError as refusal:
        if len(str(refusal)) > 1000:
            return f"a sentence of {len(str(refusal))} characters"
    except Exception:
        return traceback.format_exc(limit=-2)
    finally:
        plt.close("all")
    took = time.perf_counter() - begun
    return f"took {took:.0f} s" if took > SLOWEST_S else ""


def test_a_result_or_a_sentence(
    calls: list[Recorded], tmp_path: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(str(tmp_path))
    tries = [
        (call, parameter, value)
        for call in calls
        for parameter in call.arguments
        if parameter != "self"
        for value in ODD
        if not (parameter == "progress" and callable(value))  # its own errors are the user's
    ]
    end = time.perf_counter() + SECONDS
    found = []
    for number, at in enumerate(np.random.default_rng(SEED).permutation(len(tries))):
        call, parameter, value = tries[at]
        if time.perf_counter() > end:
            assert number > 2000, "too few calls to find anything"
            break
        if fault := wrong(call, parameter, value):
            found.append(f"{call.name}({parameter}={value!r:.60}): {fault}")
    assert not found, f"{len(found)} faults:\n" + "\n".join(found[:20])


def test_every_public_name_with_arguments_is_tried(calls: list[Recorded]) -> None:
    tried = {call.name.split(".")[0] for call in calls}
    functions = {
        name for name in cm.__all__ if callable(getattr(cm, name)) and name[0].islower()
    } - {"x"}
    assert functions - tried - APART == set()
