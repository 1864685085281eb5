"""The numbers of ISO 286 that are confirmed: standard tolerances and fundamental deviations.

All of them in um, one for each of the STEPS_MM. Everything else is computed from them, in `fits`.

A number stands here if two tables that were published apart from each other have it: the package
pressfit 0.1.0 and the table of rf-tolerance, for grades and shafts; for the holes F and G the
package isofits 1.0 and rf-tolerance. tests/data/iso_286.json holds the other tables, and
test_fits.py compares them cell by cell. None is what could not be confirmed: F and G outside what
isofits has; G from 3 to 6 mm, where the one says 4 and the other 2; s above 50 mm, where the
standard has finer steps.
"""

STEPS_MM = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
"""Each step goes from over the last of these diameters up to and with this one, the first from 0.
"""

GRADES = {
    5: (4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27),
    6: (6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40),
    7: (10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63),
    8: (14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97),
    9: (25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140, 155),
    10: (40, 48, 58, 70, 84, 100, 120, 140, 160, 185, 210, 230, 250),
    11: (60, 75, 90, 110, 130, 160, 190, 220, 250, 290, 320, 360, 400),
}
"""How wide a tolerance zone of a grade is."""

UPPER: dict[str, tuple[int | None, ...]] = {
    "d": (-20, -30, -40, -50, -65, -80, -100, -120, -145, -170, -190, -210, -230),
    "e": (-14, -20, -25, -32, -40, -50, -60, -72, -85, -100, -110, -125, -135),
    "f": (-6, -10, -13, -16, -20, -25, -30, -36, -43, -50, -56, -62, -68),
    "g": (-2, -4, -5, -6, -7, -9, -10, -12, -14, -15, -17, -18, -20),
    "h": (0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0),
}
"""The upper deviations of shafts that are thinner than their nominal size."""

LOWER: dict[str, tuple[int | None, ...]] = {
    "k": (0, 1, 1, 1, 2, 2, 2, 3, 3, 4, 4, 4, 5),
    "m": (2, 4, 6, 7, 8, 9, 11, 13, 15, 17, 20, 21, 23),
    "n": (4, 8, 10, 12, 15, 17, 20, 23, 27, 31, 34, 37, 40),
    "p": (6, 12, 15, 18, 22, 26, 32, 37, 43, 50, 56, 62, 68),
    "s": (14, 19, 23, 28, 35, 43, None, None, None, None, None, None, None),
    "F": (None, 10, 13, 16, 20, 25, 30, 36, 43, 50, 56, 62, None),
    "G": (None, None, 5, 6, 7, 9, 10, 12, 14, 15, 17, 18, None),
    "H": (0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0),
}
"""The lower deviations of thicker shafts and, with capital letters, of holes."""

LAST_GRADE_OF_K = 7
"""Above it the lower deviation of k is 0."""

SYMMETRIC = "js"
"""The shaft whose zone lies half above the nominal size and half below."""
