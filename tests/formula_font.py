"""Make the font of the pages' formulas: `python tests/formula_font.py STIXMath-Regular.otf`.

The font is version 1.1.1 of the STIX Fonts, as Debian's package fonts-stix has it. What is kept is
what formulas like ours use; what is changed is what a browser does otherwise than a word processor.
"""

import sys
from pathlib import Path
from typing import Any

from fontTools import subset
from fontTools.pens.boundsPen import BoundsPen
from fontTools.pens.t2CharStringPen import T2CharStringPen
from fontTools.pens.transformPen import TransformPen
from fontTools.ttLib import TTFont
from fontTools.ttLib.tables import otTables

TARGET = Path(__file__).parents[1] / "src" / "cammotion" / "site" / "fonts" / "formulas.woff"
NAME = "Workbook Math"  # another one than the original's, as its licence asks
KEPT = {
    *range(0x20, 0x7F),
    *range(0x391, 0x3AA),  # Greek, upright
    *range(0x3B1, 0x3CA),
    *range(0x1D434, 0x1D468),  # in italics, as a single letter in a formula is
    *range(0x1D6E2, 0x1D71C),
    *map(ord, "ℎ±·×µ°²³∂∆∇∈∑∏√∛∞∫−∕∗∣∥≈≠≤≥≪≫←→⇒↔‖…⋯⋅′″‴‾¯–∝∩∪⊂ℝ"),  # noqa: RUF001
    *(0x2061, 0x2062, 0x302, 0x304, 0x305, 0x307, 0x308),
}
INTEGRAL, PRIMES = 0x222B, (0x2032, 0x2033, 0x2034)
BESIDE = 40  # what is between an integral and its upper limit, in units of the font
LARGER, BOTTOM, CLOSER = 1.5, 80, 30  # a prime is drawn for a superscript


def reduced(path: str) -> Any:
    """Return the font with what is kept of it."""
    options = subset.Options()
    options.name_IDs = [0, 13, 14]
    options.glyph_names = options.hinting = False
    font = TTFont(path)
    subsetter = subset.Subsetter(options)
    subsetter.populate(unicodes=KEPT)
    subsetter.subset(font)
    font["CFF "].cff.fontNames = [NAME.replace(" ", "")]
    for number, text in {1: NAME, 2: "Regular", 4: NAME, 6: NAME.replace(" ", "")}.items():
        font["name"].setName(text, number, 3, 1, 0x409)
    return font


def widen_integrals(font: Any) -> None:
    """Make integrals as wide as they are drawn; a lower limit moves back by the difference."""
    glyphs, table = font.getGlyphSet(), font["MATH"].table
    variants = table.MathVariants
    found = dict(
        zip(variants.VertGlyphCoverage.glyphs, variants.VertGlyphConstruction, strict=True)
    )
    first = font.getBestCmap()[INTEGRAL]
    names = {first, *(one.VariantGlyph for one in found[first].MathGlyphVariantRecord)}
    info = otTables.MathItalicsCorrectionInfo()
    info.Coverage = otTables.Coverage()
    info.Coverage.glyphs = sorted(names, key=font.getReverseGlyphMap().get)
    info.ItalicsCorrection = []
    for name in info.Coverage.glyphs:
        pen = BoundsPen(glyphs)
        glyphs[name].draw(pen)
        width, left = font["hmtx"][name]
        wide = round(pen.bounds[2]) + BESIDE
        font["hmtx"][name] = (wide, left)
        record = otTables.MathValueRecord()
        record.Value, record.DeviceTable = wide - width, None
        info.ItalicsCorrection.append(record)
    info.ItalicsCorrectionCount = len(names)
    table.MathGlyphInfo.MathItalicsCorrectionInfo = info


def enlarge_primes(font: Any) -> None:
    """Draw primes larger and lower: MathML has them in a superscript, small and high."""
    glyphs, charstrings = font.getGlyphSet(), font["CFF "].cff.topDictIndex[0].CharStrings
    for sign in PRIMES:
        name = font.getBestCmap()[sign]
        bounds = BoundsPen(glyphs)
        glyphs[name].draw(bounds)
        width, left = (round(LARGER * size) - CLOSER for size in font["hmtx"][name])
        pen = T2CharStringPen(width - CLOSER, glyphs)
        down = BOTTOM - LARGER * bounds.bounds[1]
        glyphs[name].draw(TransformPen(pen, (LARGER, 0, 0, LARGER, -CLOSER, down)))
        old = charstrings[name]
        charstrings[name] = pen.getCharString(old.private, old.globalSubrs)
        font["hmtx"][name] = (width - CLOSER, left)


if __name__ == "__main__":
    made = reduced(sys.argv[1])
    widen_integrals(made)
    enlarge_primes(made)
    made.flavor = "woff"
    made.save(TARGET)
