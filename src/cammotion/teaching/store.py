"""What the learner has done, in a small file beside the learner's copies.

The file is `progress.json` in the folder of the copies, `work` or another. Where a notebook runs
elsewhere, as in a test or when it is graded, nothing is written and all is forgotten at the end.
It holds records by kind and key, fields that are not known are left as they are:

exercises    "01.1": state; tries; hints, the furthest one; who, whose numbers were asked for;
             given, the last number; choice, a letter; slips, how often each reason was given, by
             its short name; again, the rows with fresh numbers
predictions  "01.half": text, as it was typed
learner      "variant": name, as it was given to cm.variant
"""

import json
import os
import tempfile
import time
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext, suppress
from pathlib import Path
from typing import Any

from cammotion.teaching.lock import only_one

FILE = "progress.json"
LOCK = ".progress.lock"
GRADING = "NBGRADER_EXECUTION"  # nbgrader sets it while it executes a notebook
_MOST = 10**6
_STALE_S = 60  # a part that is older was left behind by a kernel that was killed

Record = dict[str, Any]
Content = dict[str, dict[str, Record]]


class Store:
    """Records by kind ("exercises", "predictions") and key; read anew before each change.

    Between reading and writing no other process does either, so that no change is lost.
    """

    def __init__(self, find_folder: Callable[[], Path | None]) -> None:
        self._find_folder = find_folder
        self._known: Content = {}
        self._unwritten: Content = {}
        self._kept_aside = ""
        self._not_written = ""

    @property
    def complaint(self) -> str:
        """What the learner has to know of the file, "" if all is well."""
        return " ".join(filter(None, [self._kept_aside, self._not_written]))

    @property
    def file(self) -> Path | None:
        """The file, None where nothing is written."""
        folder = self._find_folder()
        return folder / FILE if folder else None

    def records(self, kind: str) -> dict[str, Record]:
        """Return all records of a kind, from this kernel and from earlier ones."""
        with self._alone() if self._is_there() else nullcontext():
            return dict(self._load().get(kind, {}))

    def update(self, kind: str, key: str, **changes: Any) -> None:
        """Change fields of one record, and write the file."""
        self.change(kind, key, lambda _: changes)

    def change(self, kind: str, key: str, how: Callable[[Record], Record]) -> None:
        """Change the fields of one record that `how` returns for what it is now; write the file."""
        with self._alone():
            before = self._load().get(kind, {}).get(key, {})
            _change(self._unwritten, {kind: {key: how(before)}})
            self._known = self._load()
            self._save(self._known)

    def _is_there(self) -> bool:
        with suppress(OSError):
            return self.file is not None and self.file.exists()
        return False

    def _alone(self) -> AbstractContextManager[None]:
        """Keep other processes from the file; Windows replaces no file that another one reads."""
        return only_one(self.file.with_name(LOCK)) if self.file else nullcontext()

    def _load(self) -> Content:
        """Return what the file holds, with the changes that could not be written to it."""
        content = self._read()
        _change(content, self._unwritten)
        return content

    def _read(self) -> Content:
        file = self.file
        try:
            if file is None or not file.exists():
                return self._known
            content = json.loads(file.read_text(encoding="utf-8"))
            if not all(
                isinstance(record, dict) for kind in content.values() for record in kind.values()
            ):
                raise ValueError("not of this workbook")
        except (OSError, ValueError, AttributeError, RecursionError):
            self._keep_aside(file)
            return self._known
        return dict(content)

    def _save(self, content: Content) -> None:
        """Write the file whole or not at all; what cannot be written stays in memory."""
        file, part = self.file, ""
        if file is None:
            return
        try:
            with tempfile.NamedTemporaryFile(
                "w", encoding="utf-8", dir=file.parent, prefix=f".{FILE}.", delete=False
            ) as new:
                part = new.name
                json.dump(content, new, indent=1, sort_keys=True)
            Path(part).replace(file)
        except OSError as wrong:
            self._not_written = (
                f"Your progress could not be written ({wrong.strerror or wrong}); it is kept until "
                "this notebook is closed."
            )
        else:
            self._not_written, self._unwritten = "", {}
        finally:
            _remove_parts(file.parent, part)

    def _keep_aside(self, file: Path | None) -> None:
        """Keep a file that cannot be read under another name, and go on with a new one."""
        if file is None:
            return
        names = (file.with_name(f"progress-unreadable-{number}.json") for number in range(1, 1000))
        with suppress(OSError):
            aside = next((name for name in names if not name.exists()), None)
            if aside:
                file.replace(aside)
                self._kept_aside = (
                    f"Your file {FILE} could not be read. It was kept as {aside.name}, and a new "
                    "one was begun."
                )


def count(record: Any, field: str) -> int:
    """Return a count of a record; what a file holds that is none counts as 0."""
    return counts(record).get(field, 0)


def counts(record: Any) -> dict[str, int]:
    """Return those fields of a record, if it is one, that are counts above 0 and believable."""
    fields = record.items() if isinstance(record, dict) else ()
    return {name: value for name, value in fields if type(value) is int and 0 < value < _MOST}


def _change(content: Content, changes: Content) -> None:
    """Change fields of records, where they are or not."""
    for kind, records in changes.items():
        known = content.setdefault(kind, {})
        for key, fields in records.items():
            known[key] = {**known.get(key, {}), **fields}


def _remove_parts(folder: Path, part: str) -> None:
    """Remove a half-written file, and those that killed kernels left behind."""
    old = time.time() - _STALE_S
    with suppress(OSError):
        for left in folder.glob(f".{FILE}.*"):
            if str(left) == part or left.stat().st_mtime < old:
                left.unlink()


def work_folder() -> Path | None:
    """Return the folder of the learner's copies in which this kernel runs, if it is in one."""
    if GRADING in os.environ:
        return None
    with suppress(OSError):  # the folder may be gone
        here = Path.cwd()
        for folder in (here, *here.parents):
            if folder.name.startswith("work") and (folder.parent / "workbook.py").is_file():
                return folder
    return None
