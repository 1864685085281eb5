"""Six short implementations of two motion laws, for the bug hunt of notebook 05.

Five of them are wrong, on purpose. Their mistakes are of the kinds that are met in published
programs. Each takes x, an array of places from 0 to 1, and returns S, V and A there. Which one is
right is for the learner to find out, by testing.
"""

from collections.abc import Callable, Mapping

import numpy as np
from numpy import cos, pi, sin

from cammotion.quantities import Floats

Curves = tuple[Floats, Floats, Floats]


def law_a(x: Floats) -> Curves:
    """Return the modified sine."""
    c = 2 / (pi * (2 + pi))
    zones = [x <= 1 / 8, x <= 7 / 8]
    w, u = 4 * pi * x, (4 * pi * x + pi) / 3
    ends = pi * x - sin(w) / 4
    s = np.select(zones, [ends, 2 + pi * x - 9 / 4 * sin(u)], 4 + ends)
    v = np.select(zones, [pi - pi * cos(w), pi - 3 * pi * cos(u)], pi - pi * cos(w))
    a = np.select(zones, [sin(w), sin(u)], sin(w))
    return c * s, c * v, c * 4 * pi**2 * a


def law_b(x: Floats) -> Curves:
    """Return the modified trapezoid."""
    s = 35 * x**4 - 84 * x**5 + 70 * x**6 - 20 * x**7
    v = 140 * x**3 - 420 * x**4 + 420 * x**5 - 140 * x**6
    a = 420 * x**2 - 1680 * x**3 + 2100 * x**4 - 840 * x**5
    return s, v, a


def law_c(x: Floats) -> Curves:
    """Return the modified trapezoid."""
    c = 8 * pi / (2 + pi)
    k, y = 4 * pi, np.minimum(x, 1 - x)
    zones = [y <= 1 / 8, y <= 3 / 8]
    u, w = y - 1 / 8, y - 3 / 8
    s_1, v_1 = c / k * (1 / 8 - 1 / k), c / k
    s_2, v_2 = s_1 + v_1 / 4 + c / 32, v_1 + c / 4
    sine = c / k * (y - sin(k * y) / k), c / k * (1 - cos(k * y)), c * sin(k * y)
    flat = s_1 + v_1 * u + c * u**2 / 2, v_1 + c * u, c + 0 * y
    cosine = s_2 + v_2 * w + c / k * (1 - cos(k * w)), v_2 + c / k * sin(k * w), c * cos(k * w)
    s, v, a = (np.select(zones, pair[:2], pair[2]) for pair in zip(sine, flat, cosine, strict=True))
    return np.where(x <= 1 / 2, s, 1 - s), v, np.where(x <= 1 / 2, a, -a)


def law_d(x: Floats) -> Curves:
    """Return the modified sine."""
    c = 1 / (4 + pi)
    zones = [x <= 1 / 8, x <= 7 / 8]
    w, u = 4 * pi * x, (4 * pi * x + pi) / 3
    ends = pi * x - sin(w) / 4
    s = np.select(zones, [ends, 2 + pi * x - 3 / 4 * sin(u)], 4 + ends)
    v = np.select(zones, [pi - pi * cos(w), pi - pi * cos(u)], pi - pi * cos(w))
    a = np.select(zones, [sin(w), sin(u) / 3], sin(w))
    return c * s, c * v, c * 4 * pi**2 * a


def law_e(x: Floats) -> Curves:
    """Return the modified sine."""
    c = pi / (4 + pi)
    k, y = 4 * pi, np.minimum(x, 1 - x)
    u = k / 3 * (y - 1 / 8)
    first = y <= 1 / 8
    middle = c * (y - 1 / k) + 9 * c / k * (1 - cos(u))
    s = np.where(first, c * (y - sin(k * y) / k), middle)
    v = np.where(first, c * (1 - cos(k * y)), c * (1 + 3 * sin(u)))
    a = c * k * np.where(first, sin(k * y), cos(u))
    return np.where(x <= 1 / 2, s, 1 - s), v, np.where(x <= 1 / 2, a, -a)


def law_f(x: Floats) -> Curves:
    """Return the modified trapezoid."""
    c = 8 * pi / (2 + pi)
    k, y = 4 * pi, np.minimum(x, 1 - x)
    zones = [y <= 1 / 8, y <= 3 / 8]
    u, w = y - 1 / 8, y - 3 / 8
    s_1, v_1 = c / k * (1 / 8 - 1 / k), c / k
    s_2, v_2 = s_1 + v_1 / 4 + c / 32, v_1 + c / 4
    sine = c / k * (y - sin(k * y) / k), c / k * (1 - cos(k * y)), c * sin(k * y)
    flat = s_1 + v_1 * u + c * u**2 / 2, v_1 + c * u, c + 0 * y
    cosine = s_2 + v_2 * w + c / k**2 * (1 - cos(k * w)), v_2 + c / k * sin(k * w), c * cos(k * w)
    s, v, a = (np.select(zones, pair[:2], pair[2]) for pair in zip(sine, flat, cosine, strict=True))
    return np.where(x <= 1 / 2, s, 1 - s), v, np.where(x <= 5 / 8, a, -a)


SUSPECTS: Mapping[str, Callable[[Floats], Curves]] = {
    "a": law_a,
    "b": law_b,
    "c": law_c,
    "d": law_d,
    "e": law_e,
    "f": law_f,
}
"""The six by their letters."""
