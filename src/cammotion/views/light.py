"""Colours for a browser that is too old for light-dark(): those of light paper, day and night."""

import re

_ASKED = "(color:light-dark(red,red))"
KNOWS, KNOWS_NOT = f"@supports {_ASKED}", f"@supports not {_ASKED}"
_RULE = re.compile(r"([^{}]*)\{([^{}]*light-dark[^{}]*)\}")
_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
_COLOUR = re.compile(r"([\w-]+): ?light-dark\((#\w+), ?#\w+\)")


def with_light(style: str) -> str:
    """Return a style in which each rule with such colours is followed by one without.

    >>> with_light("a{color:light-dark(#111,#eee)}").partition("@")[2]
    'supports not (color:light-dark(red,red)){a{color-scheme:light;color:#111}}'
    """
    return _RULE.sub(_followed, style)


def _followed(rule: re.Match[str]) -> str:
    selector = _COMMENT.sub("", rule[1]).strip()
    light = ";".join(f"{name}:{value}" for name, value in _COLOUR.findall(rule[2]))
    return f"{rule[0]}{KNOWS_NOT}{{{selector}{{color-scheme:light;{light}}}}}"
