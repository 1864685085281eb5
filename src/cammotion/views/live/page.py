"""A live figure as a page that needs nothing else: no kernel, no network, no other file."""

import base64
import gzip
import json
import re
from functools import cache
from html import escape
from pathlib import Path
from typing import Any

from cammotion.views.light import with_light

_FOLDER = Path(__file__).parent
_COMMENT = re.compile(r"^ *(/\*\*.*?\*/|//[^\n]*)\n", re.MULTILINE | re.DOTALL)
"""Of whole lines: who reads the source has them, a page is smaller without."""
_PAGE = """\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
:root{{color-scheme:light dark}}
body{{font-family:system-ui,sans-serif;max-width:960px;margin:auto;padding:.5em}}
pre{{white-space:pre-wrap;overflow-wrap:anywhere;font:inherit}}
</style>
</head>
<body>
<main>
<h1>{title}</h1>
<div id="place"><pre>{text}</pre></div>
</main>
<script type="application/json" id="figure">{data}</script>
<script type="module">{script}</script>
</body>
</html>
"""
# module and style are packed, the same in each page; the formulas are what is read
_SCRIPT = """
const unpacked = new Blob([Uint8Array.from(atob("{packed}"), (letter) => letter.charCodeAt(0))])
  .stream().pipeThrough(new DecompressionStream("gzip"));
const source = await new Response(unpacked).text();
const address = URL.createObjectURL(new Blob([source], {{ type: "text/javascript" }}));
const {{ default: figure, style, modelOf }} = await import(address);
document.head.append(Object.assign(document.createElement("style"), {{ textContent: style }}));
const model = modelOf(JSON.parse(document.getElementById("figure").textContent));
const place = document.getElementById("place");
place.textContent = "";
figure.render({{ model, el: place }});
"""


@cache
def module() -> str:
    """Return the front-end module: what computes, what draws, what listens."""
    return "".join(map(_read, ("formulas.js", "controls.js", "panel.js", "figure.js")))


def model() -> str:
    """Return what gives a module its model where there is no kernel."""
    return _read("model.js")


@cache
def style() -> str:
    """Return the figure's style sheet."""
    return with_light(_read("figure.css"))


def write_page(data: dict[str, Any], text: str) -> str:
    """Return a page from what a figure has stored: description, settings, pinned settings.

    `text` is what a reader without JavaScript sees.
    """
    stored = in_script(as_json(data))
    script = _COMMENT.sub("", module() + model())
    whole = f"{script}export const style = {json.dumps(style())};\n"
    packed = base64.b64encode(gzip.compress(whole.encode(), mtime=0)).decode("ascii")
    return _PAGE.format(
        title=escape(data["description"]["title"]),
        text=escape(text),
        data=stored,
        script=_SCRIPT.format(packed=packed),
    )


def as_json(data: Any) -> str:
    """Return data as one line of JSON."""
    return json.dumps(data, ensure_ascii=False, separators=(",", ":"))


def in_script(data: str) -> str:
    """Return JSON as it may stand in a script element."""
    return data.replace("<", "\\u003c")


def _read(name: str) -> str:
    return (_FOLDER / name).read_text(encoding="utf-8")
