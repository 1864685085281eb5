"""How a typed prediction is read: one table, for Python and as JSON for the script of a page.

A prediction is one number, and beside it stands nothing but words that are known: the question's
own, those that say nothing, and those that go with the question. An unknown word makes no number,
since it may be another unit, a bound or a direction. So a word that learners use is added to a
list, and no pattern is needed against the others.

The patterns are of what both languages read alike: no flags, no names of groups, and none of the
classes `b`, `d`, `s` and `w`. Each is through a text in one go: what is typed may be long.
"""

from collections.abc import Iterator

Rows = list[list[str]]

_LETTER = "[a-zμß-öø-ɏ]"
_DIGITS = r"(?:[0-9]+(?:[.,][0-9]+)?|\.[0-9]+)"
_SECOND = "s(?:ec(?:ond)?s?)?"
_PER_S2 = (
    rf"(?: ?(?:/|per) ?\(?{_SECOND}(?: ?(?:\^|\*\*)?2| squared|(?:/| per ){_SECOND})\)?"
    rf"| per square {_SECOND}| ?[·.*]?s\^?-2)"
)
_ZEROS = (0x660, 0x6F0, 0x966)  # of Arabic, Persian and Hindi, whose other digits follow them
_CARDINALS = "zero one two three four five six seven eight nine ten eleven twelve"
_ORDINALS = "first second third fourth fifth sixth seventh eighth ninth tenth"
_LESS = (
    "less lower smaller fewer weaker gentler lighter milder down"
    " falls drop drops decrease decreases reduction"
)
_MORE = "more higher larger greater bigger"
_DOWN_TO = "(?:falls|drops|goes|down) to"
_IN_WORDS = (
    f"^ ?(?:about )?(?:1/[0-9]+ share|2 times|double)(?: of (?:it|that|the stroke)| as {_LETTER}+)?"
    "[,:;](?: so)? (?=[0-9.])"
)


def _word(words: str, plain: str) -> list[str]:
    """Return how words are written plainly, wherever they stand for themselves."""
    return [f"(?<!{_LETTER})(?:{words})(?!{_LETTER})", plain]


def _alone(words: str, plain: str) -> list[str]:
    """Return how a number in words is written: within a sentence it may be a part of another."""
    return [f"^ ?(?:(?:about|only|just|maybe|at|i think) )*(?:{words})(?!{_LETTER})", plain]


def _foreign_digits() -> Iterator[list[str]]:
    for digit in range(10):
        yield [f"[{''.join(chr(zero + digit) for zero in _ZEROS)}]", f"{digit}"]


def _numbers_in_words() -> Iterator[list[str]]:
    """Yield a half as "1/2 share", since it is one of something, and eight as "8"."""
    yield _alone("twice", "2 times")
    yield _alone("(?:an? |one )?half", "1/2 share")
    yield _alone("(?:an? |one )?(?:quarter|fourth)", "1/4 share")
    yield _alone("two thirds", "2/3 share")
    yield _alone("three quarters", "3/4 share")
    for number, name in enumerate(_ORDINALS.split()[2:], 3):
        yield _alone(f"(?:an?|one) {name}", f"1/{number} share")
    for number, name in enumerate(_CARDINALS.split()):
        yield _alone(name, f"{number}")


def _places() -> Iterator[list[str]]:
    for number, name in enumerate(_ORDINALS.split(), 1):
        yield ["place", *_word(name, f"{number}")]


SIGNS: Rows = [
    ["(?<=[0-9])(?=[¼½¾⅐-⅞])", " "],  # 1½
    ["(?<![A-Za-z⁻])[²³¹⁰-⁹⁻₀-₉]+", "^"],  # 10² is no 102
    ["[º˚]", "°"],
]
"""What is written otherwise before letters are made small, and ² becomes 2 (NFKC)."""

PLAINLY: Rows = [
    [r"[ \t-\r\x1c-\x1f\x85\u2028\u2029\u200b\u200e\u200f\u2060\ufeff]+", " "],
    ["[−–—]", "-"],
    [r" ?[\u2044\u2215÷/] ?", "/"],
    *_foreign_digits(),
    ["!=", "not "],
    ["^ ?= ?", ""],
    [r"\$?t_m\$?", "tm"],
    # a_max = 1.04
    [rf"(?<!{_LETTER})(c_?[avj]|tm|{_LETTER})(?:_?(?:max|peak|[0-9]))? ?[=≈]", "$1_ "],
    [  # 185/2 = 92.5
        r"^(?=[^=≈]*[0-9])[^=≈a-z_<>]*(?:(?:x|pi|sqrt|(?:a|arc)?tan|times|plus|minus)"
        r"[^=≈a-z_<>]*)?(?<!\()[=≈] ?(?=[^=≈0-9]*[0-9][^=≈]*$)",
        "=",
    ],
    ["^ ?['\"\u2018\u201c](.*)['\"\u2019\u201d] ?$", "$1"],  # 'in quotes'
    [r"^([^0-9]*)(?:\+ ?/? ?-|±|plus or minus)", "$1"],
    ["^ ?(?:- |minus )(?=[0-9.])", "-"],
    [r"(?<![0-9.,])([0-9]{1,3})[ '\u2019]([0-9]{3})(?![0-9]|[.,][0-9])", "$1$2"],  # 4 500
    [rf"['\u2019](?:s|d|m|ll)(?!{_LETTER})", ""],
    _word(f"m(?:et(?:er|re)s?)?{_PER_S2}", "mss"),
    _word(f"in(?:ch(?:es)?)?{_PER_S2}", "inss"),
    _word("mms|millimet(?:er|re)s?", "mm"),
    ["°|deg(?:ree)?s?", "deg"],
    ["per ?cents?|pct|prozent", "%"],
    ["of (?:a|one) %", "%"],
    [f"(?:in )?(?:/|per |an |one |each )h(?:ou)?r?(?!{_LETTER})|hourly", " per hour"],
    [" ?at (?:110|0) ?deg", ""],  # where it is asked about
    ["(?:out )?of (?:the )?(?:18|24)(?![.,]?[0-9])", "of them"],  # all there are
    [" ?of (?:the )?cam angle", ""],
    [f"(?<!{_LETTER})(?:(?:in|on|to|for|at|per) (?=each)|in (?=all|total|place))", ""],
    ["-ish", ""],
    _word("more or less|close to|not far from", "about"),
    _word("(?:has|have|had) to (?:be|guess|say)|equal to|equals", "is"),
    _word("or so|or thereabouts|or something|(?:than|as) before|not sure|no idea|i don't know", ""),
    [f" ?(?:[x×*·]|times) ?tm(?!{_LETTER})", " tm"],
    ["tm/([0-9]+)", "1/$1 tm"],
    ["(factor|peak|depth|push|radius) of (?=[-0-9.])", "$1 "],
    _word("(?:drop|decrease|reduction) (?:of|by)", "less"),
    _word(f"(?:becomes|{_DOWN_TO})(?! (?:about |only )?[0-9]+/)", "gets"),
    _word("half-?way|mid[- ]?stroke", "middle"),
    ["^ ?(?:none|nothing|not at all)[,:;] (?=0(?![.,]?[0-9]))", ""],
    _word("x(?!_)|×", " times "),
    [f"-?fold(?!{_LETTER})", " times "],
    *_numbers_in_words(),
    # half a degree
    [f"(?: share (?:of )?(?:an? |one )?| of (?:an?|one) )(?=(?:deg|mm)(?!{_LETTER}))", " "],
]
"""What is written otherwise, one after the other, in a question and in what is typed."""

WHERE_ASKED: Rows = [
    # nobody counts pieces to three decimals, but what is reckoned out may have them
    ["hour", r"(?<![0-9.,=])([1-9][0-9]{0,2})\.([0-9]{3})(?!e?[-+.,]?[0-9])", "$1$2"],
    ["%(?! less| above)", "(%|share|/[0-9]+) of", "$1"],
    ["% less", "(?:the|its) peak (?=falls|drops)", ""],
    ["% above", r"^ ?(?:\+|plus) ?(?=[0-9.])", ""],
    # half, 2.08; but in 0.5 it is said again
    ["tm", _IN_WORDS, ""],
    ["", rf"{_IN_WORDS}(?!0?[.,](?:50?|25|33|20?|10?)(?![0-9])|2(?![0-9.,]))", ""],
    ["hour", "limited by (?=the)", ""],
    ["^mm$", "^ ?no[,:;.] ", ""],  # is it where it should be?
    # larger, 1.5; but larger, 20 % is by how much
    ["times the", "^ ?(?:larger|bigger)[,:;] (?=[1-9](?![0-9])[^%/]*$)", ""],
    ["times the", "^ ?(?:a (?:bit|little) )?(?:smaller|lower)[,:;] (?=0?[.,][5-9][^%/]*$)", ""],
    ["times the", "^([^0-9]*[1-9][0-9.,]* *times) +(?:larger|bigger|higher)(?=[^a-z%]*$)", "$1"],
    *_places(),
]
"""A pattern of a question, and what is written otherwise where it is asked."""

NUMBER = (
    rf"(?<![0-9_.,/^+-])(?<!{_LETTER})(?:([0-9]+) (?=[0-9]+/))?"
    rf"(-?{_DIGITS}(?:e[-+]?[0-9]+)?)(?:/({_DIGITS}))?(?![.,]?[0-9])"
)
"""A number, with the groups 1 (before a fraction, as in 1 1/2), 2, and 3 (after a stroke).

One with a plus is by how much something changes, and none.
"""

COUNTED = "of them|place"
"""A pattern of questions that a whole number answers; a stroke parts it from all there are."""

REMARK = r"(?:, |;|: |[.!?] |\(| - | ?= ?| because | since | that )(?!of it).*$"
"""What follows a number and says more of it: 1.04, a quarter of it."""

WORD = f"{_LETTER}+_?"
"""A word, or the name of a quantity, with a stroke: "a_ 1.04" is what "a = 1.04" becomes."""

PART = f"{WORD}|[^ ]"
"""Of what stands beside a number: a word, or a sign."""

PLAIN = """
. , ; : ! ? ~ ≈ = ( ) [ ] $ ` #
about ca circa approx approximately around roughly near nearly almost close some quite ish
pretty much rather just only exactly precisely somewhere still same equal unchanged
i think thinking guess guessing hope believe expect suppose estimate reckon say bet fear
my predict prediction answer result maybe perhaps probably possibly surely sure
hmm well so then yes x_ thereabouts that this it its is be will would should could might must
the a an on at for rim mill die sucker gripper
"""
"""What may stand beside any number."""

NOT_OWN = "of in to least above where was inertia"
"""Words of questions that say something else beside a number: an inch, a bound, another unit."""

BESIDE: Rows = [
    ["%", "% by share"],
    ["fraction", "% of share"],
    ["times", "times factor"],
    ["times (?!the)", "by"],
    ["times as fast", f"share as much high large hard impact faster quicker speed {_MORE}"],
    ["times smaller", "as small"],
    ["times the", "% of share as large big much"],
    ["less|smaller", f"{_LESS} reduced"],
    ["above", f"{_MORE} worse best"],
    ["of them", "of them line out wrong are errors break there counted count found"],
    ["place", "of them number no rank strongest"],
    ["each way", "direction side one per"],
    ["of the stroke", "each side way covers"],
    ["^(?!.*(?:each|stroke|inss))", "all total"],
    ["hour", "rate pieces piece parts part units pcs p pph limits"],
    ["mm", "deep depth radius prime circle r_"],
    ["^mm$", "flies cam too high low much by gap away off"],
    ["^mm$|inss", "worst place"],
    ["inss", "by up to either way"],
    ["peak of", "with modified mod trapezoid"],
    ["^(?!.*%)", "get gets"],
    ["tm", "t_ u_ start in beginning middle else"],
    ["depth", "d_ s_"],
    ["mss|inss", "a_"],
    ["push", "with pushes a_ c_ ca_ f_ p_"],
    ["hour|of them|place", "n_"],
]
"""A pattern of a question, and what else may stand beside a number where it is asked."""

BEHIND: Rows = [
    ["^$", "times deg mm mss inss m s g h"],
    ["place", "st nd rd th"],
    ["less|smaller", "below under off"],
    ["above", "above over off"],
    ["depth", "down"],
    ["^mm$", "from"],
    ["inertia", "inertia"],
]
"""Likewise, but only behind the number: before it, some of them make it a bound."""

TELLING = f"""
% mm cm m km um μm micron microns thou mil in inch inches deg rad mrad arcmin mss inss
s sec seconds min minute minutes hour day g kg n k thousand
{_LESS} {_MORE} under over below above least most max maximum minimum than not
up off rises increase increased slower faster worse better times factor doubled halved quartered
again added addition additional extra top left rest remain remains remaining
from before after past bottom end weakest right correct ok wrong total all both each
other others share mass grows
diameter across arc arcmins arcminute arcminutes arcsec arcseconds rpm thousands
"""
"""What counts in a remark, too: a unit, a bound, a direction."""


def as_table() -> dict[str, Rows | str]:
    """Return all of it by the names that the script of a page has for it."""
    return {
        "signs": SIGNS,
        "plainly": PLAINLY,
        "whereAsked": WHERE_ASKED,
        "number": NUMBER,
        "counted": COUNTED,
        "remark": REMARK,
        "word": WORD,
        "part": PART,
        "plain": PLAIN,
        "notOwn": NOT_OWN,
        "beside": BESIDE,
        "behind": BEHIND,
        "telling": TELLING,
    }
