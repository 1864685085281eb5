"""The first page: what the workbook is about, and where each of its pages is."""

from collections.abc import Iterable
from html import escape

from cammotion.site.lessons import Lesson

TITLE = "Cam motion and machine timing"
DESCRIPTION = "How should the parts of a machine move, so that it runs fast and still lives long?"
_ABOUT = """\
# Cam motion and machine timing

Somewhere a machine makes two thousand pieces an hour. A die comes down, presses, and has to be
gone before the wheel beneath it moves on. **How should its parts move, so that it runs fast and
still lives long?**

![Two designs of one machine, in motion side by side and by one clock. On the left the die waits
for the mill and then rushes, with up to 4.15 m/s². On the right both overlap, and the die needs a
fifth of that.](motion.svg)

On the left is a die that waits until the wheel stands still, on the right one that does not. Both
make the same number of pieces, and the right one needs a fifth of the acceleration. These pages
derive it, prove it, and let you try it.

## The pages

<ol class="lessons">
{lessons}
</ol>

## How to use them

**Predict.** Two or three times in a lesson you are asked for a result before it is shown. Type
your guess and press Enter: further down the answer opens, and says how far off you were.

**Explore.** The figures live in the page. Drag a slider, type a number, or use the arrow keys.

**Check yourself.** The exercises at the end answer at once, and say what probably went wrong.
What you type stays in your browser, and is gone when you close the page.

**Then run it.** Each page was made from a notebook. In the workbook you can change every line of
its code, put in a machine of your own, and have exercises with numbers of your own.
"""


def contents(lessons: Iterable[Lesson]) -> str:
    """Return the first page in Markdown."""
    return _ABOUT.format(lessons="\n".join(map(_line, lessons)))


def _line(lesson: Lesson) -> str:
    minutes = f' <span class="minutes">{lesson.minutes} minutes</span>' if lesson.minutes else ""
    question = escape(lesson.question)
    return (
        f'<li><a href="{lesson.name}.html"><span class="number">{lesson.number}</span> '
        f"{escape(lesson.title)}</a>{minutes} "
        f'<span class="question">{question}</span></li>'
    )
