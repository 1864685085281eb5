"""The pictures of notebook 10: run this file to draw them anew.

One is the moving picture of the follower that leaves its cam, the other the two masses and what
each of them feels when it is cut free.
"""

from pathlib import Path

import cammotion as cm

IMAGES = Path(__file__).parent.parent / "notebooks" / "images"
JUMP, TWO_MASSES = IMAGES / "jump.svg", IMAGES / "two_masses.svg"
MIDDLE, LOW = 86, 216  # where the parts are joined, and where they are cut free
BLOCKS = ((300, "1"), (560, "2"))  # x of the left side of a mass, and its number
SIDE, CAM = 90, 110
INK = 'stroke="#1b1b1b" stroke-width="2" fill="none"'


def flights() -> cm.Flights:
    """Return what the lesson's die does at 3000 pieces an hour."""
    load = cm.FollowerLoad(mass_kg=12, stiffness_N_per_mm=0.5, preload_N=40)
    return cm.follower_flights(cm.EXAMPLE.die, load, 3000)


def jump() -> str:
    return cm.animate_follower(flights()).svg


def written(x: float, y: float, *parts: str, size: int = 16) -> str:
    """Return words; each second part is an index, set lower."""
    spans = "".join(
        f'<tspan dy="5" font-size="{size - 4}">{part}</tspan><tspan dy="-5">&#8203;</tspan>'
        if number % 2
        else f"<tspan>{part}</tspan>"
        for number, part in enumerate(parts)
    )
    return f'<text x="{x}" y="{y}" text-anchor="middle" font-size="{size}">{spans}</text>'


def spring(left: float, right: float, y: float) -> str:
    """Return a zigzag between two places."""
    start, end, teeth = left + 24, right - 24, 8
    step = (end - start) / teeth
    inner = " ".join(
        f"{start + step * (number + 0.5):.1f},{y + (9 if number % 2 else -9)}"
        for number in range(teeth)
    )
    return f'<polyline points="{left},{y} {start},{y} {inner} {end},{y} {right},{y}" {INK}/>'


def damper(left: float, right: float, y: float) -> str:
    """Return a piston in its pot."""
    middle = (left + right) / 2
    return (
        f'<path d="M {left} {y} H {middle - 4} M {middle - 4} {y - 8} v 16 '
        f"M {middle + 18} {y - 12} h -36 M {middle + 18} {y + 12} h -36 "
        f'M {middle + 18} {y - 12} v 24 M {middle + 18} {y} H {right}" {INK}/>'
    )


def block(x: float, y: float, number: str) -> str:
    return (
        f'<rect x="{x}" y="{y - 38}" width="{SIDE}" height="76" fill="#d9e6f2" stroke="#1b1b1b" '
        f'stroke-width="2"/>{written(x + SIDE / 2, y + 6, "m", number, size=18)}'
    )


def arrow(x: float, y: float, length: float, colour: str = "#0072B2") -> str:
    """Return an arrow whose tip is `length` to the right, or for a negative one to the left."""
    back = 9 if length > 0 else -9
    tip = x + length
    return (
        f'<path d="M {x} {y} H {tip}" stroke="{colour}" stroke-width="3" fill="none"/>'
        f'<path d="M {tip} {y} l {-back} -6 v 12 z" fill="{colour}"/>'
    )


def two_masses() -> str:
    """Return the picture of the two masses, joined above and cut free below."""
    (first, _), (second, _) = BLOCKS
    links = ((CAM, first, "1"), (first + SIDE, second, "2"))
    joined = "".join(
        spring(left, right, MIDDLE - 18)
        + damper(left, right, MIDDLE + 20)
        + written((left + right) / 2, MIDDLE - 36, "k", number)
        + written((left + right) / 2, MIDDLE + 54, "b", number)
        for left, right, number in links
    )
    blocks = "".join(block(x, y, number) for x, number in BLOCKS for y in (MIDDLE, LOW))
    ways = arrow(CAM - 20, 26, 40, "#D55E00") + written(CAM - 38, 32, "s")
    for x, number in BLOCKS:
        ways += arrow(x + 40, 26, 40, "#D55E00") + written(x + 22, 32, "y", number)
    forces = "".join(
        (
            arrow(first - 62, LOW, 60),
            written(first - 140, LOW + 6, "k", "1", " (s − y", "1", ")"),
            arrow(first + SIDE + 62, LOW, -60),
            arrow(second - 62, LOW, 60),
            written((first + SIDE + second) / 2, LOW + 36, "k", "2", " (y", "1", " − y", "2", ")"),
        )
    )
    return f"""<svg xmlns="http://www.w3.org/2000/svg" width="760" height="284" \
viewBox="0 0 760 284" class="cm-drawing" role="img" \
font-family="DejaVu Sans, Verdana, Arial, sans-serif" style="background: white">
<title>Two masses behind a cam, joined and cut free</title>
<desc>A cam moves the end of the spring k1 and the damper b1 by s. Behind them is the mass m1, \
then the spring k2 with the damper b2, and the mass m2. Cut free, m1 is pushed by k1 (s − y1) \
from the left and by k2 (y1 − y2) from the right, m2 by k2 (y1 − y2) from the left.</desc>
<rect width="760" height="284" fill="white"/>
<path d="M {CAM} {MIDDLE - 40} v 80" stroke="#1b1b1b" stroke-width="4"/>
<path d="M {CAM - 70} {MIDDLE} H {CAM}" {INK}/>
{written(CAM - 40, MIDDLE - 10, "cam")}
{joined}{blocks}{ways}{forces}
</svg>
"""


if __name__ == "__main__":
    for path, drawn in ((JUMP, jump()), (TWO_MASSES, two_masses())):
        path.write_text(drawn, "utf-8", newline="")
