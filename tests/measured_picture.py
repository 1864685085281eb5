"""The moving picture of notebook 09: run this file to draw it anew.

The measured cam turns by the clock of its machine, a quarter turn a second, and lifts its follower;
beside it a dot runs along the acceleration of the second differences.
"""

from pathlib import Path

import numpy as np
from measured_cam import CAM, RATE

import cammotion as cm

PICTURE = Path(__file__).parent.parent / "notebooks" / "images" / "measured.svg"
WIDTH, HEIGHT, TURN_S = 760, 356, 4
BASE, SCALE = 44.0, 0.62  # px of the base circle, and of a mm of lift
CENTRE = (150.0, 212.0)
LEFT, RIGHT, TOP, BOTTOM = 350.0, 735.0, 40.0, 285.0
HIGH = 18.0  # in/s2 at the upper edge, and below zero at the lower
STYLE = """<style>/*<![CDATA[*/
.cm-drawing text { stroke-linejoin: round; paint-order: stroke }
@media (prefers-reduced-motion: reduce) { .cm-still .cm-moves { transform: none !important } }
/*]]>*/</style>"""


def points(pairs: list[tuple[float, float]]) -> str:
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in pairs)


def outline() -> str:
    """Return the cam whose topmost point is the lift at each angle, turning clockwise."""
    spline = cm.smoothed(CAM, 0)
    at = np.arange(0, 360, 2.0)
    radius = BASE + SCALE * np.asarray(spline.at(at))
    x, y = radius * np.sin(-np.radians(at)), -radius * np.cos(np.radians(at))
    return points([*zip(x.tolist(), y.tolist(), strict=True)])


def follower() -> str:
    """Return how high the follower is, in px, all along a turn."""
    lifts = SCALE * np.asarray(cm.smoothed(CAM, 0).at(np.arange(0, 361, 2.0)))
    return ";".join(f"0 {-lift:.2f}" for lift in lifts)


def chatter() -> list[tuple[float, float]]:
    """Return the acceleration of the second differences, in px."""
    found = cm.differences(CAM, RATE)
    angle = np.append(found.angle_deg, 360)
    values = np.append(found.acceleration, found.acceleration[0]) / 0.0254
    x = LEFT + (RIGHT - LEFT) * angle / 360
    y = (TOP + BOTTOM) / 2 - (BOTTOM - TOP) / 2 * values / HIGH
    return [*zip(x.tolist(), y.tolist(), strict=True)]


def drawn() -> str:
    """Return the picture."""
    middle, line = (TOP + BOTTOM) / 2, chatter()
    dots = "".join(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="#0072B2"/>' for x, y in line)
    ticks = "".join(
        f'<text x="{LEFT + (RIGHT - LEFT) * a / 360:.1f}" y="{BOTTOM + 20}" '
        f'text-anchor="middle" font-size="13">{a}</text>'
        for a in (0, 90, 180, 270, 360)
    )
    levels = "".join(
        f'<text x="{LEFT - 6}" y="{middle - (BOTTOM - TOP) / 2 * v / HIGH + 5:.1f}" '
        f'text-anchor="end" font-size="13">{str(v).replace("-", "−")}</text>'
        for v in (-15, 0, 15)
    )
    (left, start), *_ = line
    runs = ";".join(f"{x - left:.1f} {y - start:.1f}" for x, y in line)
    top = CENTRE[1] - BASE
    turn = f'dur="{TURN_S}s" repeatCount="indefinite"'
    return f"""<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" \
viewBox="0 0 {WIDTH} {HEIGHT}" class="cm-drawing cm-still" role="img" \
font-family="DejaVu Sans, Verdana, Arial, sans-serif" style="background: white">
{STYLE}
<title>A measured cam turns, and its acceleration chatters</title>
<desc>A cam turns once in 4 s and lifts its follower by 114.3 mm. Beside it the acceleration over \
the cam angle, from point to point: it jumps up and down between −17 and 13 in/s².</desc>
<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>
<g transform="translate({CENTRE[0]} {CENTRE[1]})"><g class="cm-moves">
<animateTransform attributeName="transform" type="rotate" from="0" to="360" {turn}/>
<polygon points="{outline()}" fill="#d9e6f2" stroke="#1b1b1b" stroke-width="2"/>
<line x1="0" y1="0" x2="0" y2="{-BASE + 6}" stroke="#1b1b1b" stroke-width="1.5"/>
</g><circle r="7" fill="white" stroke="#1b1b1b" stroke-width="2"/></g>
<g class="cm-moves">
<animateTransform attributeName="transform" type="translate" values="{follower()}" {turn}/>
<path d="M {CENTRE[0]} {top:.1f} l -8 -16 v -60 h 16 v 60 z" fill="#f4cfae" stroke="#1b1b1b" \
stroke-width="2"/></g>
<text x="{CENTRE[0]}" y="{HEIGHT - 8}" text-anchor="middle" font-size="13">\
real speed: a turn in 4 s</text>
<text x="{LEFT}" y="22" font-size="14">acceleration in in/s²</text>
<line x1="{LEFT}" x2="{RIGHT}" y1="{middle}" y2="{middle}" stroke="#1b1b1b"/>
<line x1="{LEFT}" x2="{LEFT}" y1="{TOP}" y2="{BOTTOM}" stroke="#1b1b1b"/>
<polyline points="{points(line)}" fill="none" stroke="#0072B2" stroke-width="2"/>
{dots}{ticks}{levels}
<text x="{(LEFT + RIGHT) / 2}" y="{BOTTOM + 40}" text-anchor="middle" font-size="13">\
cam angle in degrees</text>
<g class="cm-moves"><animateTransform attributeName="transform" type="translate" \
values="{runs}" {turn}/>
<circle r="6" cx="{left:.1f}" cy="{start:.1f}" fill="#D55E00"/></g>
</svg>
"""


if __name__ == "__main__":
    PICTURE.write_text(drawn(), "utf-8", newline="")
