"""What is right and what is wrong, by lessons and without the package; a new file is found here."""

from importlib import import_module
from pathlib import Path

from known_slips import KnownSlip

_KNOWN = [
    import_module(file.stem) for file in sorted(Path(__file__).parent.glob("known_slips*.py"))
]
RIGHT = {number: answer for known in _KNOWN for number, answer in known.RIGHT.items()}
OF_THE_SOURCE = {number: value for known in _KNOWN for number, value in known.SOURCE.items()}
ALL_SLIPS: list[KnownSlip] = [slip for known in _KNOWN for slip in known.SLIPS]
