"""White paper in a page that may be dark: what is drawn on it is turned round there.

An element on paper has the class `cm-paper`, and STYLE or RULE comes with it. The drawings in the
text of the workbook's notebooks, which can have no class, follow as soon as one is in the page.
"""

_DARK = "body[data-jp-theme-light=false]", "body.vscode-dark"
_ON_PAPER = ".cm-paper", '.jp-RenderedMarkdown img[src*="notebooks/images/"]'


def _rule(within: str, *elements: str, style: str) -> str:
    return f"{','.join(f'{dark} {within}{one}' for dark in _DARK for one in elements)}{{{style}}}"


# Black and white change places, hues stay: what was white is JupyterLab's #111 then.
TURNED = "filter:invert(.933) hue-rotate(180deg)"
RULE = _rule("", *_ON_PAPER, style=TURNED) + _rule(".cm-paper ", ".cm-paper", style="filter:none")
STYLE = f"<style>{RULE}</style>"
