"""What the learner has done, in a small file where the learner's notebooks are.

The file is `progress.json`; `places` says in which folder. It holds records by kind and key,
fields that are not known are left as they are:

exercises    "01.1": state; tries; hints, the furthest one; who, whose numbers were asked for;
             right, the names for whose numbers it was right;
             given, the last number; choice, a letter; slips, how often each reason was given, by
             its short name; best, how many times the bound a right design reaches; again, the
             rows with fresh numbers
predictions  "01.half": text, as it was typed
learner      "variant": name, as it was given to cm.variant
"""

import json
import os
import secrets
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, nullcontext, suppress
from functools import cached_property
from pathlib import Path
from typing import Any

from cammotion.files import remedy
from cammotion.teaching.lock import only_one
from cammotion.teaching.places import FILE, KINDS, Place

LOCK = ".progress.lock"
_PATIENCE_S, _WHEN_TRIED_S = 5.0, 0.1  # so long waits nobody: who holds it is not at work
_MOST = 10**6
_STALE_S = 60  # a part that is older was left behind by a kernel that was killed

Record = dict[str, Any]
Content = dict[str, dict[str, Record]]
Change = Callable[[Record], Record]


class Store:
    """Records by kind, one of `places.KINDS`, and key; read anew before each change.

    Between reading and writing no other process does either, so that no change is lost. A change
    that cannot be written is kept, and made again on what the file then holds.
    """

    def __init__(self, find_place: Callable[[], Place]) -> None:
        self.find_place = find_place
        self._known: Content = {}
        self._unwritten: list[tuple[str, str, Change]] = []
        self._kept_aside = self._not_read = self._not_written = ""
        self._obstacle: OSError | None = None
        self._patience_s = _PATIENCE_S
        self._has_told = False

    @cached_property
    def place(self) -> Place:
        """Where the file is: found once, so that it stays where a notebook changes its folder."""
        return self.find_place()

    @property
    def complaint(self) -> str:
        """What the learner has to know of the file, "" if all is well."""
        return " ".join(filter(None, [self._kept_aside, self._not_read, self._not_written]))

    @property
    def where(self) -> str:
        """Where the file is, or why there is none, in a sentence; "" while it cannot be written."""
        if self._not_written:
            return ""
        kept = f"kept in {self.file}" if self.file else "not kept"
        return self.place.remark or f"Your progress is {kept}."

    def tell(self) -> str:
        """Return the complaint, and once, if it is written, what is unexpected of the place."""
        if self._not_written:
            return self.complaint
        remark = "" if self._has_told else self.place.remark
        self._has_told = True
        return " ".join(filter(None, [self.complaint, remark]))

    @property
    def file(self) -> Path | None:
        """The file, None where nothing is written."""
        return self.place.folder / FILE if self.place.folder else None

    def records(self, kind: str) -> dict[str, Record]:
        """Return all records of a kind, from this kernel and from earlier ones."""
        with self._alone() if self._is_there() else nullcontext():
            return dict(self._load().get(kind, {}))

    def update(self, kind: str, key: str, **changes: Any) -> None:
        """Change fields of one record, and write the file."""
        self.change(kind, key, lambda _: changes)

    def change(self, kind: str, key: str, how: Change) -> None:
        """Change the fields of one record that `how` returns for what it is now; write the file.

        `how` is called again whenever a change that could not be written is made anew.
        """
        self._unwritten.append((kind, key, how))
        with self._alone():
            self._save(self._load())

    def _is_there(self) -> bool:
        with suppress(OSError):
            return self.file is not None and self.file.exists()
        return False

    @contextmanager
    def _alone(self) -> Iterator[None]:
        """Keep other processes from the file; Windows replaces no file that another one reads.

        Where that cannot be, `_obstacle` says why, and nothing is written.
        """
        self._obstacle = None
        with ExitStack() as held:
            try:
                if self.file:
                    self._make_folder()
                    lock = _target(self.file).with_name(LOCK)
                    held.enter_context(only_one(lock, self._patience_s))
                self._patience_s = _PATIENCE_S
            except TimeoutError:
                self._patience_s = _WHEN_TRIED_S
                self._obstacle = OSError("another notebook has been writing to it for seconds")
            except OSError as wrong:
                self._obstacle = wrong
            yield

    def _make_folder(self) -> None:
        """Make the folder where it is ours to make; that of copies which are gone is not."""
        if self.place.folder and self.place.remark:
            self.place.folder.mkdir(parents=True, exist_ok=True)

    def _load(self) -> Content:
        """Return what the file holds, with the changes that could not be written to it."""
        self._known = self._read()
        content = dict(self._known)
        content.update({kind: dict(content[kind]) for kind in KINDS if kind in content})
        for kind, key, how in self._unwritten:
            records = content.setdefault(kind, {})
            before = records.get(key, {})
            records[key] = {**before, **how(before)}
        return content

    def _read(self) -> Content:
        """Return what the file holds; while it cannot be opened, what was known of it before."""
        file, self._not_read = self.file, ""
        try:
            if file is None or not file.exists():
                return self._known
            if not file.is_file():
                raise ValueError("a folder, or nothing that ends")
            content = json.loads(file.read_bytes())  # in any UTF, with or without a mark of it
            own = [content.get(kind, {}).values() for kind in KINDS]
            if not all(isinstance(record, dict) for records in own for record in records):
                raise ValueError("not of this workbook")
        except OSError as wrong:  # it may pass, as on a network drive
            self._obstacle = wrong
            self._not_read = (
                f"Your progress could not be read ({wrong.strerror or wrong}), and may be more "
                "than what is shown; the file is left as it is, and tried again."
            )
            return self._known
        except (ValueError, AttributeError, RecursionError):
            self._keep_aside(file)
            return self._known
        return dict(content)

    def _save(self, content: Content) -> None:
        """Write the file whole or not at all; what cannot be written stays in memory."""
        try:
            if self.file and self._obstacle:
                raise self._obstacle
            if self.file:
                _write(content, _target(self.file))
        except OSError as wrong:
            todo = remedy(wrong, "")
            self._not_written = (
                f"Your progress could not be written ({wrong.strerror or wrong}); it is kept until "
                f"this notebook is closed{todo and f': {todo}'}."
            )
        else:
            self._known = content
            self._not_written, self._unwritten = "", []

    def _keep_aside(self, file: Path | None) -> None:
        """Keep a file that cannot be read under another name, and go on with a new one."""
        if file is None or self._obstacle:
            return
        names = (file.with_name(f"progress-unreadable-{number}.json") for number in range(1, 1000))
        with suppress(OSError):
            aside = next((name for name in names if not os.path.lexists(name)), None)
            if aside:
                file.replace(aside)
                self._kept_aside = (
                    f"Your file {FILE} could not be read. It was kept as {aside.name}, and a new "
                    "one was begun."
                )


def _target(file: Path) -> Path:
    """Return the file that a link leads to, which is then the one to be replaced."""
    with suppress(OSError, RuntimeError):  # a link to itself
        return file.resolve() if file.is_symlink() else file
    return file


def _write(content: Content, file: Path) -> None:
    """Write a file whole or not at all, and through to the disk."""
    part = file.with_name(f".{FILE}.{secrets.token_hex(8)}")
    try:
        with part.open("x", encoding="utf-8") as new:
            json.dump(content, new, indent=1, sort_keys=True)
            new.flush()
            os.fsync(new.fileno())
        with suppress(OSError):
            shutil.copymode(file, part)  # a class may be allowed to read it
        part.replace(file)
    finally:
        _remove_parts(file.parent, part)


def right_for(record: Record) -> set[str]:
    """Return the names for whose numbers an exercise was right, "" for those of no name."""
    kept = record.get("right")
    names = {name for name in kept if isinstance(name, str)} if isinstance(kept, list) else set()
    return names | {str(record.get("who", ""))} if record.get("state") == "right" else names


def count(record: Any, field: str) -> int:
    """Return a count of a record; what a file holds that is none counts as 0."""
    return counts(record).get(field, 0)


def counts(record: Any) -> dict[str, int]:
    """Return those fields of a record, if it is one, that are counts above 0 and believable."""
    fields = record.items() if isinstance(record, dict) else ()
    return {name: value for name, value in fields if type(value) is int and 0 < value < _MOST}


def _remove_parts(folder: Path, part: Path) -> None:
    """Remove a half-written file, and those that killed kernels left behind."""
    old = time.time() - _STALE_S
    with suppress(OSError):
        for left in folder.glob(f".{FILE}.*"):
            if left == part or left.stat().st_mtime < old:
                left.unlink()
