"""Find and read the progress files that a teacher has collected; none of them is ever changed."""

import json
import os
import re
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path
from typing import Any

from cammotion.files import check_folder
from cammotion.quantities import InputError
from cammotion.teaching.classroom.clean import clean
from cammotion.teaching.places import FILE, KINDS, SOLUTIONS
from cammotion.teaching.store import Record

_LARGEST_BYTES = 5_000_000  # a hundred times what all lessons fill
_ASIDE = "progress-unreadable-"  # what the store itself has put aside
_ARCHIVE = ".zip"
_LESSON = re.compile(r"\d\d_.*\.ipynb$")


@dataclass(frozen=True)
class Student:
    """What one progress file holds; `place` is where it lies within the folder.

    `digest` is of the whole file, which another student hardly knows.
    """

    name: str
    place: str
    exercises: Mapping[str, Record]
    predictions: Mapping[str, str]
    digest: bytes


@dataclass(frozen=True)
class SchoolClass:
    """The students by their names, and what the teacher has to know of the files."""

    students: tuple[Student, ...]
    notices: tuple[str, ...]

    def anonymous(self) -> "SchoolClass":
        """Return the class with numbers for names, in an order that tells nothing of the names.

        Nor can it be reckoned out of names and places, which a class knows.
        """
        mixed = sorted(self.students, key=lambda student: student.digest)
        numbered = (
            replace(student, name=f"{number}", place="") for number, student in enumerate(mixed, 1)
        )
        return replace(self, students=tuple(numbered))


class _NoProgressError(Exception):
    """A file that is no progress file; the message says what it is, after "it"."""


def read_class(folder: Path) -> SchoolClass:
    """Return what the progress files in a folder hold, at any depth and under any names.

    Raises InputError where there is no folder, or no progress file in it.
    """
    remedy = "give the one into which you have collected your students' progress files"
    check_folder(folder, clean(str(folder), 200), f"{remedy} or work folders")
    notices: list[str] = []
    students: dict[tuple[str, bytes], Student] = {}

    def leave_out(path: str | Path, why: str) -> None:
        notices.append(f"The folder {_place(path, folder)} was left out: it {why}.")

    files = [*_files(folder, leave_out)]
    places = [_place(file, folder) for file in files]
    for file, place in zip(files, places, strict=True):
        try:
            raw, content = _read(file)
        except _NoProgressError as wrong:
            notices.append(f"{place} was left out: it {wrong}.")
            continue
        student, told = _told_student(content, sha256(raw).digest(), place)
        student = student if told else replace(student, name=_name_of(place, folder, places))
        key = (student.name.casefold(), raw if told else os.fsencode(file))
        if key in students:
            both = (students[key], student)
            student, other = sorted(both, key=lambda one: not _is_at_home(one, folder, places))
            notices.append(
                f"{other.place} was left out: it is the same file as {student.place}, and bears "
                f"the name {student.name}."
            )
        students[key] = student
    if not students:
        missing = (
            f"There is no {FILE} in the folder {clean(folder.name or str(folder))}, nor another "
            "progress file of the workbook. Each student's is in the folder work."
        )
        raise InputError(" ".join([missing, *notices]))
    ordered = sorted(students.values(), key=lambda student: (_plain(student.name), student.place))
    lacking = ", ".join(_place(path, folder) for path in _without(folder, files))
    notices += [f"No progress in: {lacking}."] if lacking else []
    return SchoolClass(tuple(ordered), (*notices, *_twice(ordered)))


def _plain(name: str) -> str:
    """Return a name as it is sorted: without capitals and accents."""
    parts = unicodedata.normalize("NFKD", name.casefold())
    return "".join(c for c in parts if not unicodedata.combining(c))


def _place(path: str | Path, folder: Path) -> str:
    """Return where something lies within the folder."""
    return clean(Path(path).relative_to(folder).as_posix(), 200)


def _cannot_be_opened(wrong: OSError) -> str:
    return f"cannot be opened ({wrong.strerror or wrong})"


def _files(folder: Path, leave_out: Callable[[str | Path, str], None]) -> Iterator[Path]:
    """Yield JSON files and archives in an order that is always the same; what is hidden is left.

    So is what was done in the solutions, of which an earlier version kept a file of its own.
    A folder into which nobody looks, and why, is for `leave_out`.
    """

    def tell(closed: OSError) -> None:
        leave_out(closed.filename, _cannot_be_opened(closed))

    for here, folders, names in os.walk(folder, onerror=tell):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for linked in filter(os.path.islink, (Path(here, name) for name in folders)):
            leave_out(linked, "is a link, which may lead in a circle; copy what it leads to")
        for name in sorted(names):
            file = Path(here, name)
            beside_solutions = name == FILE and file.parts[-3:-1] == SOLUTIONS
            is_one = name.lower().endswith((".json", _ARCHIVE)) and not beside_solutions
            if is_one and not name.startswith((".", _ASIDE)):
                yield file


def _without(folder: Path, files: Sequence[Path]) -> Iterator[Path]:
    """Yield in order the folders that were collected and hold no file: what somebody forgot.

    Those are folders of copies, and what lies in the folder itself.
    """
    around = {parent for file in files for parent in file.parents}
    own = {file.parent for file in files} - {folder}
    for here, folders, names in os.walk(folder):
        inside, is_empty = Path(here), not (folders or names)
        folders[:] = sorted(name for name in folders if not _is_hidden(name))
        is_in_sight = is_empty or folders or not all(map(_is_hidden, names))
        is_handed_in = inside.parent == folder and is_in_sight
        are_copies = any(_LESSON.match(name) for name in names) and inside.name not in SOLUTIONS
        if inside in own:
            folders.clear()
        elif inside not in around and (is_handed_in or are_copies):
            folders.clear()
            yield _to_the_copies(inside)


def _is_hidden(name: str) -> bool:
    return name.startswith((".", "__"))


def _to_the_copies(folder: Path) -> Path:
    """Return a folder, or what it leads to where it holds one folder and nothing else."""
    with suppress(OSError):
        held = [path for path in folder.iterdir() if not _is_hidden(path.name)]
        if len(held) == 1 and held[0].is_dir() and not held[0].is_symlink():
            return _to_the_copies(held[0])
    return folder


def _read(file: Path) -> tuple[bytes, dict[str, Any]]:
    """Return the bytes of a progress file, and what they mean; raise _NoProgressError."""
    if file.suffix.lower() == _ARCHIVE:
        raise _NoProgressError("is an archive: unpack it first")
    try:
        if not file.is_file():
            raise _NoProgressError("is no file")
        if file.stat().st_size > _LARGEST_BYTES:
            raise _NoProgressError("is far too large")
        raw = file.read_bytes()
    except OSError as wrong:
        raise _NoProgressError(_cannot_be_opened(wrong)) from None
    if not raw.strip():
        raise _NoProgressError("is empty: ask for it anew")
    try:
        content = json.loads(raw)  # in any UTF, as the store reads it
    except (ValueError, RecursionError):
        raise _NoProgressError("is broken, and cannot be read: ask for it anew") from None
    if not isinstance(content, dict) or not any(_records(content, kind) for kind in KINDS):
        raise _NoProgressError("holds no exercises and no predictions of the workbook")
    return raw, content


def _records(content: dict[str, Any], kind: str) -> dict[str, Record]:
    """Return the records of a kind, as far as they are records."""
    records = content.get(kind)
    items = records.items() if isinstance(records, dict) else ()
    return {key: record for key, record in items if isinstance(record, dict)}


def _told_student(content: dict[str, Any], digest: bytes, place: str) -> tuple[Student, bool]:
    """Return what a file holds, and whether it tells itself whose it is."""
    exercises = _records(content, "exercises")
    typed = {key: record.get("text") for key, record in _records(content, "predictions").items()}
    texts = {key: text for key, text in typed.items() if isinstance(text, str) and text.strip()}
    name = _told_name(content, exercises)
    return Student(name, place, exercises, texts, digest), bool(name)


def _told_name(content: dict[str, Any], exercises: dict[str, Record]) -> str:
    """Return the name that was given to cm.variant, "" if none was.

    Files of earlier versions have it only with each exercise, in small letters.
    """
    name = clean(_records(content, "learner").get("variant", {}).get("name"))
    whose = Counter(clean(record.get("who")) for record in exercises.values())
    del whose[""]
    return name or next((who for who, _ in whose.most_common(1)), "")


def _name_of(place: str, folder: Path, places: Sequence[str]) -> str:
    """Return a name by where a file lies: its own, or that of the folder nearest to it.

    "Anna/progress.json" is Anna's, "work-ben/progress.json" ben's, "carla.json" carla's. Of
    "Fay/cam/progress.json" and "Gert/cam/progress.json", no folder of which holds another file,
    one is Fay's and one is Gert's.
    """
    *folders, name = place.split("/")
    around = [folders[:end] for end in range(len(folders), 0, -1)]
    parts = [path[-1] for path in around if not _is_shared(path, places)]
    stem = name.rpartition(".")[0]
    candidates = [stem, *parts, clean(folder.resolve().name)]
    names = (part.removeprefix("work-") for part in candidates if part.casefold() != "work")
    return clean(next((name for name in names if name and not _is_ours(name)), "somebody"))


def _is_at_home(student: Student, folder: Path, places: Sequence[str]) -> bool:
    """Tell whether a file lies where its name says, as that of Anna in "anna/progress.json"."""
    return _name_of(student.place, folder, places).casefold() == student.name.casefold()


def _is_shared(path: list[str], places: Sequence[str]) -> bool:
    """Tell whether a folder has a name that several share, and the one above tells it from them."""
    *above, name = path
    if not above or name.startswith("work-"):
        return False
    found = [other.split("/")[:-1] for other in places]
    same = {
        tuple(other[:end]) for other in found for end, one in enumerate(other, 1) if one == name
    }
    beside = [other for other in found if other[: len(above)] == above]
    return len(same) > 1 and all(other[: len(path)] == path for other in beside)


def _is_ours(name: str) -> bool:
    """Tell whether it is the file's usual name, or "progress (1)" as browsers make it."""
    return name.casefold().rstrip(" ()-_0123456789") == Path(FILE).stem


def _twice(students: list[Student]) -> Iterator[str]:
    """Say so where several files are of one name."""
    places: dict[str, list[Student]] = {}
    for student in students:
        places.setdefault(student.name.casefold(), []).append(student)
    for same in places.values():
        if len(same) > 1:
            yield (
                f"{len(same)} files are of the name {same[0].name}: "
                f"{', '.join(student.place for student in same)}. All of them are shown; if one is "
                "an older copy, take it out of the folder."
            )
