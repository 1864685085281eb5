"""What lives in a page: the modules of live figures and of animations, and what each is given."""

import re

from cammotion.site.pictures import size_of
from cammotion.views.animation.player import clock_of
from cammotion.views.live.page import as_json, in_script

_TURN = re.compile(r'\bdur="([\d.]+)s"')
_CYCLE = re.compile(r"([\d.]+) s a turn")


def live_figure(stored: str, still: str) -> str:
    """Return a live figure: its picture, in whose place the module draws from what is stored."""
    return _living("figure", still, stored)


def animation(svg: str) -> str:
    """Return an animation: the drawing, which moves by itself, and what its player is given."""
    turn, cycle = _TURN.search(svg), _CYCLE.search(svg)
    if not turn or not cycle:
        return f'<div class="drawing cm-paper">{_bare(svg)}</div>'
    state = clock_of(float(turn[1]), float(cycle[1])) | {"angle_deg": 0}
    width, _ = size_of(svg)
    return _living("player", _bare(svg), as_json(state), f' style="--wide:{width:.0f}px"')


def _living(module: str, shown: str, state: str, style: str = "") -> str:
    return (
        f'<figure class="living"{style}><div data-module="{module}">{shown}</div>'
        f'<script type="application/json">{in_script(state)}</script></figure>'
    )


def _bare(svg: str) -> str:
    """Return an SVG without what stands before its root, as a page takes it."""
    return svg[svg.index("<svg") :]
