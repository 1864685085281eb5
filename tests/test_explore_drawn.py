"""What `explore` draws and says though it is not nice: poles, pieces, corners, searches."""

import io
from typing import Any

import numpy as np
import pytest
import sympy as sp
from PIL import Image

import cammotion as cm

t, k, b = sp.symbols("t k b")
SPAN = (t, 0, 1)


@pytest.fixture(autouse=True)
def at_a_quarter(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the clock stand where a curve is neither at its start nor at its peak."""
    monkeypatch.setattr("cammotion.views.live.figure.CLOCK", 0.25)


def test_numbers_of_numpy_are_numbers() -> None:
    ends: Any = np.float32(0), np.int64(2), np.float64(0.5)
    figure = cm.explore(
        k * t * b, (t, np.int64(0), np.float64(1)), {k: ends}, values={b: np.float64(3)}
    )
    figure.values = {k: np.float64(1.5)}
    assert "curve 1 = 1.125" in figure.text


def test_a_pole_breaks_the_curve_and_spares_the_axes() -> None:
    figure = cm.explore(1 / (t - sp.Rational(1, 4)), SPAN)  # where the clock stands, too
    assert figure.text == "at 0.25 s: curve 1 = ∞\nlargest: curve 1 = ∞"
    flat = cm.explore(sp.Piecewise((4, t < sp.Rational(1, 4)), (-4, True)), SPAN)
    assert figure.picture() != flat.picture()
    shown = np.asarray(Image.open(io.BytesIO(figure.picture())).convert("L"))
    assert (shown[:, shown.shape[1] // 2 :] < 100).any()  # there is a curve, far from the pole


def test_what_is_real_in_places_only_is_drawn_and_told() -> None:
    pieces = cm.explore(sp.Piecewise((t, t > sp.Rational(1, 2))), SPAN)
    assert pieces.text == "at 0.25 s: curve 1 = nan\nlargest: curve 1 = 1"
    root = cm.explore(sp.cbrt(t - 2) + sp.sqrt(t - 1), (t, 0, 3))
    assert root.text.startswith("at 0.75 s: curve 1 = nan")
    for figure in (pieces, root):
        assert figure._repr_mimebundle_()[0]["image/png"]


@pytest.mark.parametrize(
    "curve",
    [
        sp.Max(t, k, sp.Rational(1, 2)) + sp.Min(t, k),
        sp.Abs(t - k) + sp.sign(t - k) + sp.Heaviside(t - k),
        sp.Mod(t, k) + sp.floor(3 * t) + sp.ceiling(t) + sp.frac(t) + sp.atan2(t, k),
        sp.Piecewise((1, (t > k) & (t < 1) | sp.Eq(t, 0)), (0, sp.Not(t > 2)), (t, True)),
        sp.Piecewise((1, sp.Ne(k, 1)), (0, True)),
        sp.Integer(2),
        cm.inverse(b**2, (b, 0, 1), t),
    ],
)
def test_all_that_a_curve_may_be_made_of(curve: sp.Expr) -> None:
    figure = cm.explore(curve, SPAN, {k: (0.2, 1)})
    assert figure.picture()
    assert "largest" in figure.text
    assert figure._data["description"]["formulas"]


def test_a_sentence_may_hold_braces_texts_and_conditions() -> None:
    say = cm.Say("{{{who}}} = {it:.2f}", {"who": "k", "it": k}, k > 2, cm.Say("small"))
    figure = cm.explore(k * t, SPAN, {k: (1, 3)}, says=[say])
    assert figure.text == "small"
    figure.values = {k: 2.5}
    assert figure.text == "{k} = 2.50"
