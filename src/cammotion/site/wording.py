"""What the lessons say of the lab, in the words of a page."""

import re

_HOW_IN_LAB = re.compile(
    r"^Write your answer in place of `None`.*? you get your(?:s| own)\.", re.MULTILINE
)
_HOW_HERE = (
    "Type your answer and press Enter. If it is wrong, you are told what probably went wrong; "
    "below each question are three hints, which end before the answer. Numbers of your own, fresh "
    "ones to practise with, and the worked answers come with the workbook."
)
OTHERWISE = {
    "Run the next cell to watch your design beside the one of notebook 03, each time you have made "
    "one.": "In the workbook you can watch your design beside the one of notebook 03, each time "
    "you have made one. Here it is the one with which the figure begins.",
    "The next cell reads the weight that you have set, and makes a law of it. Run it again "
    "whenever you have found a weight that you like.": "In the workbook the next cell makes a law "
    "of the weight that you have set. Here it is the one with which the figure begins.",
    " In JupyterLab they are folded: click on the button below.": "",
    "Put your own file": "In the workbook, put your own file",
    "The check says which requirements yours meets": "In the workbook the check says which "
    "requirements yours meets",
    "The best design of 12.4 is kept": "In the workbook the best design of 12.4 is kept",
}


def as_on_a_page(markdown: str) -> str:
    """Return the text of a cell as a page says it."""
    markdown = _HOW_IN_LAB.sub(_HOW_HERE, markdown)
    for in_lab, here in OTHERWISE.items():
        markdown = markdown.replace(in_lab, here)
    return markdown
