"""The slider and the number field of one value."""

import math
from typing import Any

import pytest

import cammotion as cm


def test_slider_and_number_field_hold_one_value() -> None:
    control = cm.NumberControl("angle Bm, deg", 55, 20, 220, 1)
    control.slider.value = 70
    assert control.field.value == 70
    control.field.value = 124.84  # between the slider's steps
    assert control.value == 124.84
    assert control.slider.value == 125
    control.slider.value = 125.0  # the page says where the slider stands: no news
    assert control.value == 124.84
    control.field.value = 500  # beyond the range: the nearest that is allowed
    assert control.value == 220
    assert control.field.description == "angle Bm, deg"


def test_the_rounding_of_a_slider_does_not_reach_the_field() -> None:
    control = cm.NumberControl("machine rate N, pieces/h", 2000, 500, 5000, 50)
    control.slider.value = 2600.0000000000005
    assert control.value == 2600
    fine = cm.NumberControl("margin, mm", 1, 0, 5, 0.1)
    fine.slider.value = 3 * 0.1
    assert fine.value == 0.3


def test_a_change_is_told_once() -> None:
    control = cm.NumberControl("angle Bm, deg", 55, 20, 220, 1)
    told: list[float] = []
    control.field.observe(lambda _: told.append(control.value), "value")
    control.slider.value = 70.00000000000001
    control.value = 80.5
    assert told == [70, 80.5]
    assert control._repr_mimebundle_()["text/plain"] == "angle Bm, deg: 80.5"


@pytest.mark.parametrize("numbers", [(5, 0, 10, 0), (math.nan, 0, 1, 0.1), ("5 mm", 0, 10, 1)])
def test_what_is_no_control_is_refused_in_words(numbers: Any) -> None:
    with pytest.raises(cm.InputError, match="of a control "):
        cm.NumberControl("x", *numbers)
