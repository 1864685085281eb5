"""A page that needs no network and no second file, and the tables in it."""

from html import escape
from pathlib import Path


def whole_page(title: str, style: Path, content: str) -> str:
    """Return a page as HTML: its title, the CSS of a file, and what stands under the title."""
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n"
        f"<style>\n{style.read_text(encoding='utf-8')}</style>\n</head>\n<body>\n<main>\n"
        f"<h1>{escape(title)}</h1>\n{content}</main>\n</body>\n</html>\n"
    )


def wide_table(caption: str, head: str, rows: str, foot: str = "") -> str:
    """Return a table that is moved sideways, also by keyboard, where it is too wide.

    All but the caption is HTML already: the cells of the head, and whole rows.
    """
    name = escape(caption)
    return (
        f'<div class="wide" role="region" tabindex="0" aria-label="{name}">\n<table>\n'
        f"<caption>{name}</caption>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}</tbody>\n"
        + (f"<tfoot>{foot}</tfoot>\n" if foot else "")
        + "</table>\n</div>\n"
    )
