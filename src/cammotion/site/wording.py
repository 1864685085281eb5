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
    "Say it before you calculate. Run the next cell, and type": "Say it before you calculate: type",
    "Put them in place of the ones below. If": "In the workbook, put them in place of the ones "
    "below; if",
    "To keep your diagram, write it into": "In the workbook you keep your diagram by writing it "
    "into",
    "Choose a mass and run the cell.": "In the workbook you choose its mass.",
    "Put in its numbers.": "In the workbook, put in its numbers.",
    "Put `my_move` in the place of `die` in the explorer above and see": "In the workbook, "
    "put your move in the place of the die in the explorer above, and see",
    "Run the next cell. On the left is": "On the left is",
    "Put in your machine of notebook 03": "In the workbook, put in your machine of notebook 03",
    "To keep it, write": "In the workbook you keep it with",
    "Ask them below.": "In the workbook, ask them below.",
    "Write any expression in": "In the workbook you can write any expression in",
    "Take a motion of your machine": "In the workbook, take a motion of your machine",
    "Put your list of": "In the workbook, put your list of",
    "Or take a drawing from your own shop, and put its fits into": "Or, in the workbook, put the "
    "fits of a drawing from your own shop into",
    "Change the table below": "In the workbook, change the table below",
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
