"""Signatures that `help` shows in a line or two: kinds by their short names."""

import inspect
import re
from typing import Any

from numpy.typing import ArrayLike

from cammotion.quantities import Floats

_MODULES = re.compile(r"\b(?:[A-Za-z_]\w*\.)+(?=\w)")


class _Words:
    """A kind in words, which a signature shows as they are."""

    def __init__(self, words: str) -> None:
        self.words = words

    def __repr__(self) -> str:
        return self.words


def readable(function: Any) -> inspect.Signature:
    """Return the signature of a function with its kinds in words.

    >>> def force(motion: "cammotion.Motion", angle_deg: ArrayLike) -> float: ...
    >>> readable(force)
    <Signature (motion: Motion, angle_deg: ArrayLike) -> float>
    """
    signature = inspect.signature(function)
    parameters = [
        each.replace(annotation=_said(each.annotation)) for each in signature.parameters.values()
    ]
    return signature.replace(
        parameters=parameters, return_annotation=_said(signature.return_annotation)
    )


def _said(kind: Any) -> Any:
    if kind is inspect.Signature.empty:
        return kind
    text = kind if isinstance(kind, str) else inspect.formatannotation(kind)
    for long, short in _LONG.items():
        text = text.replace(long, short)
    return _Words(_MODULES.sub("", text))


_LONG = {
    write(kind): words
    for kind, words in ((ArrayLike | None, "ArrayLike | None"), (ArrayLike, "ArrayLike"))
    for write in (inspect.formatannotation, repr)
} | {inspect.formatannotation(Floats): "Floats"}
