"""The files that all pages share: one style sheet, and one script with every module in it."""

import json
import re
from importlib.resources import files

from cammotion.site import formulas
from cammotion.teaching.prediction_words import as_table
from cammotion.views import paper
from cammotion.views.animation import player
from cammotion.views.light import KNOWS, with_light
from cammotion.views.live import page as live
from cammotion.views.live.page import as_json

_HERE = files("cammotion.site")
# Not as modules of their own: a browser reads none from a disk, where each file is a stranger.
_START = """\
// Written by `workbook.py site`: the modules of these pages, and what starts them.
const sources = {sources};
const loaded = {{}};
const load = (name) =>
  (loaded[name] ??= import(
    URL.createObjectURL(new Blob([sources[name]], {{ type: "text/javascript" }}))
  ));
load("host").then(({{ start }}) => start(load));
"""
# Colours of code with a contrast of 4.5 at least on its paper, in both themes
_CODE = {
    ".k,.kn,.kc,.ow,.nn": ("#8b2160", "#f08bc0"),
    ".s1,.s2,.sa,.si,.se,.sd": ("#27632a", "#8fd694"),
    ".mi,.mf,.mb": ("#8a4600", "#f2b36b"),
    ".c1,.cm": ("#5b6069", "#a3a9b5"),
    ".nb,.nf,.fm,.nd": ("#1f4f9c", "#8ab4f8"),
}


def shared_files() -> dict[str, bytes]:
    """Return the files that every page uses, by their names."""
    licence = _HERE / "fonts" / "OFL.txt"
    return {
        "shared/page.css": _style().encode(),
        "shared/page.js": _script().encode(),
        **{f"shared/{file.name}": file.read_bytes() for file in (formulas.FONT, licence)},
    }


def _style() -> str:
    code = "".join(
        f".code :is({names}){{color:light-dark({light},{dark})}}\n"
        for names, (light, dark) in _CODE.items()
    )
    on_paper = ".cm-paper,[data-module]>svg"  # this before, or without, its player
    dark = f"{on_paper}{{{paper.TURNED};mix-blend-mode:lighten}}.cm-paper .cm-paper{{filter:none}}"
    turned = f"{KNOWS}{{@media screen and (prefers-color-scheme:dark){{{dark}}}}}\n"
    own = with_light(_read("page.css") + formulas.style(formulas.FONT.name) + code)
    return "".join([own, turned, live.style(), player.LOOK])


def _script() -> str:
    sources = {
        "figure": live.module(),
        "player": player.MODULE.read_text(encoding="utf-8"),
        "host": host_module(),
    }
    return _START.format(sources=as_json({name: _bare(text) for name, text in sources.items()}))


def host_module() -> str:
    """Return the module that gives the others their models, and answers what is filled in."""
    words = f"const PREDICTED = {json.dumps(as_table())};\n"
    return live.model() + words + _read("judging.js") + _read("host.js")


def _bare(source: str) -> str:
    """Return a script without the blanks at the beginnings of its lines."""
    return re.sub(r"^[ \t]+", "", source, flags=re.MULTILINE)


def _read(name: str) -> str:
    return (_HERE / name).read_text(encoding="utf-8")
