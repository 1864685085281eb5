"""What a class has predicted, as a part of the page; what is true is folded away."""

from collections import Counter
from collections.abc import Sequence
from html import escape

from cammotion.quantities import plural
from cammotion.teaching.classroom import histogram, tally
from cammotion.teaching.classroom.clean import clean
from cammotion.teaching.classroom.collect import Student
from cammotion.teaching.prediction import Prediction

_MOST_WORDS = 12


def show(made: Prediction, students: Sequence[Student]) -> str:
    """Return a histogram of the numbers that were predicted, and the words that were typed."""
    title = clean(made.key) + (f": {made.asked}" if made.asked else "")
    heading = f"<h4>{escape(title)}</h4>\n"
    typed = [s.predictions[made.key] for s in students if made.key in s.predictions]
    if not typed:
        return f"{heading}<p>Nobody has predicted anything.</p>\n"
    numbers, texts = _numbers_and_texts(made, typed)
    return (
        f'<div class="prediction">\n{heading}'
        f"<p>{len(typed)} of {plural(len(students), 'student')} predicted{_range(numbers)}.</p>\n"
        + (histogram.draw(numbers, title) if numbers else "")
        + _words(texts, "words beside the numbers" if numbers else "words")
        + _all_typed(made, typed)
        + _true(made, numbers, title)
        + "</div>\n"
    )


def _numbers_and_texts(made: Prediction, typed: Sequence[str]) -> tuple[list[float], list[str]]:
    """Part what is one number from the rest; where a text is asked for, all is the rest."""
    if isinstance(made.true, str) and made.true:
        return [], [*typed]
    found = [(text, made.numbers(text)) for text in typed]
    numbers = [one[0] for _, one in found if len(one) == 1]
    return numbers, [text for text, one in found if len(one) != 1]


def _range(numbers: Sequence[float]) -> str:
    if not numbers:
        return ""
    low, high = min(numbers), max(numbers)
    return f": {low:g}" if low == high else f", from {low:g} to {high:g}"


def _words(texts: Sequence[str], what: str) -> str:
    """Return the commonest words, with bars that a screen reader leaves out."""
    counted = tally.words(texts)[:_MOST_WORDS]
    if not counted:
        return ""
    longest = counted[0][1]
    items = "".join(
        f'<li><bdi>{escape(word)}</bdi> <span class="bar" style="width: '
        f'{12 * number / longest:.1f}em"></span> {number}</li>\n'
        for word, number in counted
    )
    return f'<p>The {what}, and how many typed them:</p>\n<ul class="words">\n{items}</ul>\n'


def _all_typed(made: Prediction, typed: Sequence[str]) -> str:
    items = "".join(
        f"<li><bdi>{escape(text)}</bdi>{f' ({number} times)' if number > 1 else ''}</li>\n"
        for text, number in Counter(clean(text, 120) for text in typed).most_common()
    )
    return (
        f"<details><summary>All that was typed for {escape(clean(made.key))}</summary>\n"
        f"<ul>\n{items}</ul></details>\n"
    )


def _true(made: Prediction, numbers: Sequence[float], title: str) -> str:
    if made.true == "":
        return ""
    said, figure = f"{made.true}", ""
    if not isinstance(made.true, str) and numbers:
        figure = histogram.draw(numbers, title, made.true)
    return (
        f"<details><summary>What is true for {made.key}</summary>\n"
        f"<p>True is: {escape(said)}.</p>\n{figure}</details>\n"
    )
