"""How far apart two colours are for an eye, and for eyes that lack one of the three cones."""

import numpy as np
from numpy.typing import NDArray

Colour = NDArray[np.float64]  # red, green and blue from 0 to 1, or L, a and b

# Of light's red, green and blue, by Machado, Oliveira and Fernandes, A physiologically-based model
# for simulation of color vision deficiency, IEEE TVCG 15 (2009), at severity 1.
SIGHT = {
    "all cones": np.eye(3),
    "protanopia": np.array(
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ]
    ),
    "deuteranopia": np.array(
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ]
    ),
    "tritanopia": np.array(
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.303900],
        ]
    ),
}
# IEC 61966-2-1: from light's red, green and blue to X, Y and Z of CIE 1931
_XYZ = np.array(
    [
        [0.4124564, 0.3575761, 0.1804375],
        [0.2126729, 0.7151522, 0.0721750],
        [0.0193339, 0.1191920, 0.9503041],
    ]
)


def rgb(code: str) -> Colour:
    """Return red, green and blue of a colour like "#1b1b1b" or "#eee"."""
    digits = code[1:] if len(code) == 7 else "".join(2 * digit for digit in code[1:])
    return np.array([int(digits[at : at + 2], 16) / 255 for at in (0, 2, 4)])


def turned_round(colour: Colour, invert: float) -> Colour:
    """Return what CSS's invert() and hue-rotate(180deg) make of a colour, by Filter Effects 1."""
    grey = np.array([0.213, 0.715, 0.072])
    inverted = np.clip(invert + colour * (1 - 2 * invert), 0, 1)
    return np.clip(2 * grey @ inverted - inverted, 0, 1)


def distance(one: Colour, other: Colour, sight: str) -> float:
    """Return the distance by CIEDE2000 as an eye sees it; 1 is just to be seen side by side."""
    first, second = (lab(np.clip(SIGHT[sight] @ light(each), 0, 1)) for each in (one, other))
    return ciede2000(first, second)


def light(colour: Colour) -> Colour:
    """Return the light of a colour's red, green and blue, as sRGB defines it."""
    return np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)


def lab(linear: Colour) -> Colour:
    """Return L, a and b of CIE 1976 of light, white being the screen's."""
    shares = _XYZ @ linear / _XYZ.sum(axis=1)
    x, y, z = np.where(
        shares > (6 / 29) ** 3, np.cbrt(shares), shares / (3 * (6 / 29) ** 2) + 4 / 29
    )
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


def ciede2000(one: Colour, other: Colour) -> float:
    """Return the distance of two colours in L, a, b: ISO/CIE 11664-6, all three weights 1."""
    stretch = 1 + _step((np.hypot(*one[1:]) + np.hypot(*other[1:])) / 2) / 2
    (c1, h1), (c2, h2) = (_chroma_and_hue(each, stretch) for each in (one, other))
    turn = (h2 - h1 + 180) % 360 - 180 if c1 * c2 else 0.0
    lightness, chroma = (one[0] + other[0]) / 2, (c1 + c2) / 2
    hue = h1 + turn / 2 if c1 * c2 else h1 + h2
    weights = zip((0.17, -0.24, -0.32, 0.2), (1, 2, 3, 4), (-30, 0, 6, -63), strict=True)
    ripple = 1 - sum(w * np.cos(np.radians(n * hue + shift)) for w, n, shift in weights)
    s_l = 1 + 0.015 * (lightness - 50) ** 2 / np.sqrt(20 + (lightness - 50) ** 2)
    d_l = (other[0] - one[0]) / s_l
    d_c = (c2 - c1) / (1 + 0.045 * chroma)
    d_h = 2 * np.sqrt(c1 * c2) * np.sin(np.radians(turn / 2)) / (1 + 0.015 * chroma * ripple)
    lean = 60 * np.exp(-(((hue % 360 - 275) / 25) ** 2))
    blue = -2 * (1 - _step(chroma)) * np.sin(np.radians(lean))
    return float(np.sqrt(d_l**2 + d_c**2 + d_h**2 + blue * d_c * d_h))


def _step(chroma: float) -> float:
    """Return 1 for a grey, falling to 0 for a strong colour."""
    return float(1 - np.sqrt(chroma**7 / (chroma**7 + 25**7)))


def _chroma_and_hue(colour: Colour, stretch: float) -> tuple[float, float]:
    a, b = colour[1] * stretch, colour[2]
    return float(np.hypot(a, b)), float(np.degrees(np.arctan2(b, a)) % 360)
