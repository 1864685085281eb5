"""Files that are written for the learner: nothing that is there already is lost."""

from pathlib import Path

from cammotion.arguments import checked
from cammotion.quantities import InputError, shorten


@checked
def write_new(path: str | Path, text: str, *, overwrite: bool = False) -> Path:
    """Write a text file, its line ends as they are, and return its path.

    A file that is there already is left as it is, with an InputError, unless `overwrite` is True.
    """
    if not isinstance(path, str | Path):
        raise InputError(f"The path of the file is {shorten(path)}: give one like 'machine.svg'.")
    path = Path(path)
    try:
        with path.open("w" if overwrite else "x", encoding="utf-8", newline="") as file:
            file.write(text)
    except FileExistsError:
        raise InputError(
            f"The file {path.name} is there already and was left as it is: choose another name, "
            "or add overwrite=True."
        ) from None
    except OSError as wrong:
        raise InputError(
            f"The file {path.name} cannot be written ({wrong.strerror}): choose a folder that is "
            "there and that you may write to."
        ) from None
    return path
