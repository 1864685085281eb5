"""The environment in .venv: when it is made, updated or kept, and why an installation fails."""

import ensurepip
import errno
import importlib.metadata
import importlib.util
import os
import re
import shutil
import socket
import sys
import time
import zipfile
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from packaging.requirements import Requirement
from small_workbook import assert_refused, lay_out, move_starter, raiser, run

from starter import commands, download, environment, inspection, installer, paths, processes
from starter.errors import WorkbookError
from starter.inspection import Environment

SOUND = Environment(
    files={"environment.txt": "a"},
    python="3.11",
    prefix="/here/.venv",
    package="/here/src/cammotion",
    versions={"numpy": "2.4.6", "six": "1.17.0"},
)


# What pip 23 and 26 and uv said of a server with such a fault, or are known to say in Windows.
SAID = [
    (
        "Could not fetch URL: There was a problem confirming the ssl certificate: SSLError("
        "SSLCertVerificationError(1, '[SSL: CERTIFICATE_VERIFY_FAILED] certificate verify failed: "
        "self-signed certificate')) - skipping\nERROR: No matching distribution found for six",
        "a certificate of its own",
    ),
    ("error sending request\n  cause: invalid peer certificate: UnknownIssuer", "SSL_CERT_FILE"),
    ("certificate verify failed: certificate has expired (_ssl.c:1006)", "date of this computer"),
    ("certificate verify failed: certificate is not yet valid", "date of this computer"),
    ("OSError('Tunnel connection failed: 407 Proxy Authentication Required')", "HTTPS_PROXY"),
    ("client error (Connect)\n  cause: tunnel error: proxy authorization required", "HTTPS_PROXY"),
    (
        "'ProxyError('Cannot connect to proxy.', OSError('Tunnel connection failed: 403 Forbidden')"
        "\nERROR: No matching distribution found for six",
        "The download is forbidden",
    ),
    ("ERROR: HTTP error 403 while getting the file", "The download is forbidden"),
    ("hint: An index returned a 403 Forbidden error.", "The download is forbidden"),
    ("HTTP status client error (403 Forbidden) for url", "The download is forbidden"),
    ("cause: client error (Connect)\n  cause: tunnel error: unsuccessful", "forbidden"),
    (
        "ERROR: Could not find a version that satisfies the requirement six (from versions: none)"
        "\nERROR: No matching distribution found for six",
        "has nothing of a package",
    ),
    ("Because six was not found in the package registry and you require it", "has nothing of"),
    ("[Errno 2] No such file: 'x'\nHINT: ... Windows Long Path support enabled.", "short path"),
    ("OSError: [WinError 206] Dateiname oder Erweiterung ist zu lang: 'C:\\\\x'", "short path"),
    ("failed to create directory `C:\\cam" + "\\deep" * 50 + "` (os error 3)", "short path"),
    ("File name too long (os error 36)", "short path"),
    (
        "OSError: [WinError 5] Zugriff verweigert: 'c:\\\\x.pyd'\nCheck the permissions.",
        "is in use",
    ),
    ("error: failed to remove file `x.pyd`: Access is denied. (os error 5)", "is in use"),
    ("PermissionError: [WinError 32] Le processus ne peut pas", "is in use"),
    (
        "Could not install packages due to an OSError: [Errno 13] Permission denied: 'x'",
        "is in use",
    ),
    ("error: failed to remove file `x.pyd`: Zugriff verweigert (os error 5)", "is in use"),
    ("error: failed to rename: le fichier est utilise (os error 32)", "is in use"),
    ("error: failed to hardlink file: Vorgang in der Cloud ungueltig (os error 396)", "OneDrive"),
    ("importing _x: library load disallowed by system policy", "group policy"),
    ("the program is blocked by group policy", "group policy"),
    ("[Errno 63] x", "short path"),
    ("ERROR: 403 Client Error: Forbidden for url", "forbidden"),
    ("invalid peer certificate: Expired", "date of this computer"),
    ("Input/output error (os error 5)", "lines above"),
    ("Broken pipe (os error 32)", "lines above"),
    ("OSError: [WinError 1260] Ce programme est bloque", "group policy"),
    ("Failed to query Python interpreter: blocked by group policy (os error 1260)", "group policy"),
    ("DLL load failed: An Application Control policy has blocked this file.", "group policy"),
    (
        "warning: Failed to hardlink files; falling back to full copy.\nerror: failed to hardlink "
        "file: The cloud operation cannot be performed on a file with incompatible hardlinks. "
        "(os error 396)",
        "OneDrive, which refuses the links",
    ),
]


@pytest.fixture(autouse=True)
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a small workbook."""
    return move_starter(tmp_path, monkeypatch)


@pytest.mark.parametrize(
    ("changes", "state", "reason"),
    [
        ({}, "ready", ""),
        ({"versions": {"numpy": "2.4.6", "six": "1.17.0", "own": "1"}}, "ready", ""),
        ({"versions": {"numpy": "2.4.6"}}, "changed", "six is missing"),
        (
            {"versions": {"numpy": "2.5.5", "six": "1.17.0"}},
            "changed",
            "numpy is 2.5.5 instead of 2.4.6",
        ),
        ({"files": {"environment.txt": "new"}}, "changed", "environment.txt changed"),
        ({"python": "3.12"}, "broken", "3.12"),
        ({"prefix": "/there/.venv"}, "broken", "moved"),
        ({"package": ""}, "broken", "moved"),
    ],
)
def test_the_environment_is_compared(changes: dict[str, Any], state: str, reason: str) -> None:
    """Each difference between environment and stamp has its verdict."""
    verdict = inspection.compare(SOUND, SOUND._replace(**changes))
    assert verdict[0] == state
    assert reason in verdict[1]


def test_what_asks_for_an_installation(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Pins and the server's switch do; an edit of the tools' settings in pyproject.toml not."""
    probe = "import json; print(json.dumps(dict(python='', prefix='', package='', versions={})))"
    monkeypatch.setattr(inspection, "VENV_PYTHON", Path(sys.executable))
    monkeypatch.setattr(inspection, "PROBE", probe)
    (root / ".venv").mkdir()
    before = inspection.inspect()
    assert before
    inspection.write_stamp(before)
    (root / "pyproject.toml").write_text("[tool.ruff]\n")
    assert inspection.judge() == ("ready", "")
    (root / "environment.txt").write_text("six==1.17.0\n")
    assert inspection.judge() == ("changed", "environment.txt changed")
    paths.SERVER_SWITCH.write_text("{}")
    assert inspection.judge() == ("changed", "environment.txt and cammotion.json changed")


def test_without_stamp_or_python_it_is_broken(root: Path) -> None:
    """A half-made environment is not trusted."""
    assert inspection.compare(None, SOUND)[0] == "broken"
    assert inspection.compare(SOUND, None)[0] == "broken"
    assert inspection.judge()[0] == "missing"
    (root / ".venv").mkdir()
    inspection.STAMP.write_text('{"files": ')
    assert inspection.judge()[0] == "broken"


def test_a_foreign_environment_is_kept_aside(
    root: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What the user made by hand is renamed, what the starter made is removed."""
    venv = root / ".venv"
    for name in (".venv-old", ".venv-old-2"):
        venv.mkdir()
        (venv / "mine.txt").write_text("mine")
        environment.clear_the_way()
        assert (root / name / "mine.txt").exists()
        assert f"kept as {name}." in capsys.readouterr().out
    venv.mkdir()
    environment.MARKER.touch()
    environment.clear_the_way()
    assert not venv.exists()
    assert not (root / ".venv-old-3").exists()


def sound(root: Path) -> Environment:
    """Return what the small workbook asks for, and one package more."""
    versions = {"no-such-package": "1.0", "own": "1"}
    return SOUND._replace(package=str(root / "src" / "cammotion"), versions=versions)


def test_a_new_environment_is_marked_and_stamped(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The mark lets the starter remove it later, the stamp says what was installed; not more."""
    monkeypatch.setattr(installer, "find_uv", lambda: "uv")  # so that no pip is laid in
    seen: list[bool] = []

    def install(step: str, whole: bool) -> None:
        assert (step, whole) == ("[2/3]", False)
        seen.extend([environment.MARKER.is_file(), inspection.STAMP.exists()])

    monkeypatch.setattr(installer, "install_packages", install)
    monkeypatch.setattr(inspection, "inspect", lambda: sound(root))
    environment.ensure()
    assert seen == [True, False]
    assert "may remove it" in environment.MARKER.read_text()
    assert environment.MARKER.parent == inspection.STAMP.parent == root / ".venv"
    assert (root / ".venv" / "pyvenv.cfg").is_file()
    stamp = inspection.read_stamp()
    assert stamp == sound(root)._replace(versions={"no-such-package": "1.0"}, whole=False)
    assert inspection.judge() == ("ready", "")
    assert capsys.readouterr().out.splitlines()[-1] == "[3/3] Checking the environment"
    monkeypatch.setattr(installer, "install_packages", raiser(AssertionError("nothing is to do")))
    environment.ensure()
    environment.clear_the_way()
    assert not (root / ".venv").exists()
    assert not (root / ".venv-old").exists()


def test_an_update_is_stamped_anew(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """While it installs there is no stamp: what is killed on the way is not trusted."""
    monkeypatch.setattr(installer, "find_uv", lambda: "uv")  # so that no pip is laid in
    (root / ".venv").mkdir()
    inspection.write_stamp(sound(root)._replace(versions={"no-such-package": "0.9"}))
    seen = []
    monkeypatch.setattr(inspection, "inspect", lambda: sound(root))
    monkeypatch.setattr(
        installer,
        "install_packages",
        lambda step, whole: seen.append((step, whole, inspection.STAMP.exists())),
    )
    environment.ensure()
    assert seen == [("[1/2]", True, False)]  # with what the tests need, as it was
    assert inspection.read_stamp() == sound(root)._replace(versions={"no-such-package": "1.0"})
    said = capsys.readouterr().out.splitlines()
    assert said[0] == (
        "The environment in .venv is updated: no-such-package is 1.0 instead of 0.9."
    )
    assert said[-1] == "[2/2] Checking the environment"


PINS = """-e .
alpha==1.0
    # via
    #   cammotion
    #   gamma
beta==1.0 ; os_name == 'posix'
    # via gamma
delta==1.0
    # via cammotion
gamma==1.0
    # via cammotion
zeta==1.0
    # via
    #   cammotion
    #   beta
"""
PROJECT = """[project]
dependencies = ["alpha>=1"]
[project.optional-dependencies]
lab = ["delta>=1,<2"]
test = ["gamma>=1", "zeta", "delta"]
"""


def test_a_learner_gets_what_is_not_for_the_tests_alone(root: Path) -> None:
    """Asked for by the package or the lab, or by what they ask for."""
    (root / "environment.txt").write_text(PINS)
    (root / "pyproject.toml").write_text(PROJECT)
    assert download.requirements(whole=False) == ["--editable=.", "alpha==1.0", "delta==1.0"]
    assert download.requirements(whole=True) == ["-r", "environment.txt"]
    (root / "environment.txt").write_text(PINS.replace("via cammotion\ngamma", "via alpha\ngamma"))
    assert download.pinned_packages(whole=False) == {"alpha", "delta"}
    (root / "environment.txt").write_text(PINS.replace("#   beta", "#   delta"))
    assert download.pinned_packages(whole=False) == {"alpha", "delta", "zeta"}
    assert download.pinned_packages() == {"alpha", "beta", "gamma", "delta", "zeta"}


def test_the_learners_part_is_complete(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever a pinned package of it asks for is in it, and the tools of the tests are not."""
    monkeypatch.undo()  # the real workbook's
    pinned = {f"{name}{pin}".partition(" ")[0] for name, pin, _ in download.entries(whole=True)}
    learners = download.pinned_packages(whole=False)
    found, more = set[str](), {("cammotion", "lab")}
    while more:
        found |= {name for name, _ in more}
        asked = {one for name, extra in more for one in asked_by(name, extra)}
        more = {one for one in asked if one[0] not in found and as_pinned(one[0]) in pinned}
        assert {name for name, _ in asked} <= learners
    assert not {"mypy", "nbval", "playwright", "pytest", "ruff", "hypothesis"} & learners


def as_pinned(name: str) -> str:
    """Return a package as environment.txt would pin it, in the version that is here."""
    return f"{name}=={importlib.metadata.version(name)}"


def asked_by(name: str, extra: str) -> Iterator[tuple[str, str]]:
    """Yield what a package that is installed asks for, on this machine."""
    for line in importlib.metadata.requires(name) or ():
        asked = Requirement(line)
        if asked.marker is None or asked.marker.evaluate({"extra": extra}):
            yield re.sub("[-_.]+", "-", asked.name).lower(), ",".join(asked.extras)


def test_the_tests_bring_what_they_need(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A learner's environment is ready for a lesson; for the tests it is completed, once."""
    monkeypatch.setattr(installer, "find_uv", lambda: "uv")
    (root / ".venv").mkdir()
    asked: list[bool] = []
    monkeypatch.setattr(inspection, "inspect", lambda: sound(root))
    monkeypatch.setattr(installer, "install_packages", lambda _, whole: asked.append(whole))
    inspection.write_stamp(sound(root)._replace(whole=False))
    environment.ensure()
    assert asked == []
    environment.ensure(whole=True)
    environment.ensure(whole=True)
    environment.ensure()
    assert asked == [True]
    assert "is updated: the tests need more packages." in capsys.readouterr().out


@pytest.mark.parametrize("now", [None, SOUND])
def test_an_environment_without_the_package_gets_no_stamp(
    root: Path, monkeypatch: pytest.MonkeyPatch, now: Environment | None
) -> None:
    """Its Python does not run, or finds another cammotion."""
    (root / ".venv").mkdir()
    monkeypatch.setattr(inspection, "inspect", lambda: now)
    with pytest.raises(WorkbookError, match="Python does not find cammotion"):
        environment.record("[3/3]", whole=True)
    assert not inspection.STAMP.exists()


@pytest.mark.parametrize("error", [OSError(errno.ENOSPC, "full"), KeyboardInterrupt()])
def test_nothing_half_made_stays(
    root: Path, monkeypatch: pytest.MonkeyPatch, error: BaseException
) -> None:
    """A new environment that cannot be completed is removed."""
    monkeypatch.setattr(environment, "create", (root / ".venv").mkdir)
    monkeypatch.setattr(installer, "install_packages", raiser(error))
    with pytest.raises(type(error)):
        environment.ensure()
    assert not (root / ".venv").exists()


@pytest.mark.parametrize("room_mb", [10**6, 900, 0])
def test_the_old_environment_stays_until_the_new_one_is_there(
    root: Path, monkeypatch: pytest.MonkeyPatch, room_mb: int
) -> None:
    """Of a folder that was moved, with no network; where there is no room for two, it goes."""
    venv = root / ".venv"
    room = SimpleNamespace(free=room_mb * 1_000_000)
    monkeypatch.setattr(shutil, "disk_usage", lambda _: room)
    monkeypatch.setattr(environment, "create", venv.mkdir)
    monkeypatch.setattr(inspection, "inspect", lambda: sound(root))
    for error in (WorkbookError("no network"), KeyboardInterrupt()):
        venv.mkdir(exist_ok=True)
        environment.MARKER.touch()
        inspection.write_stamp(SOUND)  # of another folder
        monkeypatch.setattr(installer, "install_packages", raiser(error))
        with pytest.raises(WorkbookError if room_mb < 1000 else type(error)):
            environment.ensure()
        assert inspection.STAMP.exists() == (room_mb >= 1000)
        assert not (root / ".venv-before").exists()
    room.free = 10**12
    monkeypatch.setattr(installer, "install_packages", lambda _step, _whole: None)
    environment.ensure()
    assert inspection.judge() == ("ready", "")
    assert [path.name for path in root.glob(".venv*")] == [".venv"]


def test_what_was_put_aside_by_a_start_that_was_killed_comes_back_or_goes(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Half-made is what that start left in .venv."""
    for name in (".venv", ".venv-before"):
        (root / name).mkdir()
    environment.MARKER.touch()
    (environment.BEFORE / "whole").touch()
    monkeypatch.setattr(environment, "create", raiser(WorkbookError("no network")))
    with pytest.raises(WorkbookError):
        environment.ensure()
    assert [path.name for path in (root / ".venv").iterdir()] == ["whole"]
    assert not environment.BEFORE.exists()


def test_an_update_that_touched_nothing_leaves_the_stamp(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without network the environment stays good for the next start; half-updated it does not."""
    monkeypatch.setattr(installer, "find_uv", lambda: "uv")
    (root / ".venv").mkdir()
    monkeypatch.setattr(installer, "install_packages", raiser(WorkbookError("no network")))
    for now, kept in ((SOUND, True), (SOUND._replace(versions={"six": "1.17.0"}), False)):
        inspection.write_stamp(SOUND)
        monkeypatch.setattr(inspection, "inspect", lambda now=now: now)
        with pytest.raises(WorkbookError):
            environment.update("environment.txt changed", whole=False)
        assert inspection.STAMP.exists() == kept


@pytest.mark.parametrize(
    ("output", "words"),
    [
        ("OSError: [Errno 28] No space left on device", "disk is full"),
        ("failed to copy: No space left on device (os error 28)", "disk is full"),
        ("Failed to establish a new connection: [Errno 111] Connection refused", "no connection"),
        ("[Errno -3] Temporary failure in name resolution", "no connection"),
        ("Cannot connect to proxy. ERROR: No matching distribution found", "no connection"),
        ("cause: dns error", "no connection"),
        ("ERROR: No matching distribution found for numpy==2.4.6", "3.11 to 3.14"),
        ("Because numpy has no wheels: No solution found when resolving", "3.11 to 3.14"),
        ("/x/.venv/bin/python: No module named pip", "Delete the folder .venv"),
        ("something else", "lines above"),
        *SAID,
    ],
)
def test_installers_are_understood(output: str, words: str) -> None:
    """What pip and uv say, in any language of Windows, is put into a sentence."""
    assert words in installer.explain(output)


def test_progress_is_read_from_pip() -> None:
    """The line says how many packages, and which is the latest."""
    lines = ["Looking in indexes\n"]
    assert installer.describe_progress(lines, 0, 9) == "looking for packages"
    lines += ["Collecting anyio==4.16.0 (from -r x)\n", "Processing ./files/arrow-1.4.0-py3.whl\n"]
    assert installer.describe_progress(lines, 0, 9) == "fetched 2 of 9: arrow"
    assert installer.describe_progress(lines, 5, 9) == "installed 5 of 9"


def test_a_failing_installer_shows_its_last_lines() -> None:
    """The reader sees what went wrong and where the rest is."""
    script = "print('Collecting six'); print('Connection refused'); raise SystemExit(3)"
    with pytest.raises(WorkbookError) as caught:
        installer.run([sys.executable, "-c", script], lambda _lines: "")
    text = str(caught.value)
    assert "    Connection refused\n" in text
    assert "no connection" in text
    log = Path(text.split("said: ")[1].splitlines()[0])
    assert "Collecting six" in log.read_text()
    log.unlink()


@pytest.mark.parametrize("name", ["venv", "ensurepip"])
def test_a_python_without_its_modules_is_refused(
    root: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """Debian splits them off; nothing is made before that is known."""
    found = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda wanted: None if wanted == name else found(wanted)
    )
    monkeypatch.setattr(shutil, "which", lambda _command: None)
    with pytest.raises(WorkbookError, match=r"apt install python3\.\d+-venv(.|\n)*uv"):
        environment.ensure()
    assert not (root / ".venv").exists()


def test_a_path_in_which_no_environment_can_be_made_is_refused(tmp_path: Path) -> None:
    """As that of a folder that is called 1/2 in the Finder; what is there stays."""
    root = lay_out(tmp_path / f"Kurs 1{os.pathsep}2")
    (root / ".venv").mkdir()
    assert_refused(run(root, "setup"), f"since the path has a {os.pathsep!r}", "Rename that folder")
    assert [path.name for path in root.glob(".venv*")] == [".venv"]


def test_too_small_a_disk_is_refused(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The free space is looked at before anything is made."""
    monkeypatch.setattr(environment, "MB_FOR_NEW", 10**9)
    with pytest.raises(WorkbookError, match="MB are free"):
        environment.ensure()
    assert not (root / ".venv").exists()


def make_wheel(folder: Path) -> None:
    """Make a package of one module, which pip can install without a network."""
    info = "cam_probe-1.0.dist-info"
    files = {
        "cam_probe.py": "",
        f"{info}/METADATA": "Metadata-Version: 2.1\nName: cam-probe\nVersion: 1.0\n",
        f"{info}/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
        f"{info}/RECORD": "",
    }
    with zipfile.ZipFile(folder / "cam_probe-1.0-py3-none-any.whl", "w") as wheel:
        for name, content in files.items():
            wheel.writestr(name, content)


def test_packages_go_into_the_environment_whatever_the_user_has_set(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A real pip, told to install for the user and elsewhere, by variables and by its file."""
    make_wheel(root)
    (root / "environment.txt").write_text("cam-probe==1.0\n")
    (root / "pip.conf").write_text("[global]\nuser = true\n")
    monkeypatch.setattr(installer, "find_uv", lambda: None)
    use_bundled_pip(monkeypatch)
    elsewhere = dict.fromkeys(("PIP_TARGET", "PIP_PREFIX", "PIP_ROOT"), "elsewhere")
    own = {"PIP_USER": "1", "PIP_CONFIG_FILE": str(root / "pip.conf")}
    index = {"PIP_NO_INDEX": "1", "PIP_FIND_LINKS": "."}
    for name, value in (elsewhere | own | index).items():
        monkeypatch.setenv(name, value)
    monkeypatch.setenv("HOME", str(root))
    environment.create()
    installer.install_packages("[2/3]", whole=False)
    now = inspection.inspect()
    assert now
    assert now.versions["cam-probe"] == "1.0"
    assert not (root / "elsewhere").exists()


def test_what_uv_made_is_updated_without_uv(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An environment of uv's has no pip, and uv may be gone: it gets one, a real one."""
    make_wheel(root)
    monkeypatch.setattr(installer, "find_uv", lambda: "uv")
    environment.create()
    bare = inspection.inspect()
    assert bare
    assert not bare.versions
    (root / "environment.txt").write_text("cam-probe==1.0\n")
    monkeypatch.setattr(environment, "record", lambda _step, _whole: None)
    monkeypatch.setattr(installer, "find_uv", lambda: None)
    for name, value in {"PIP_NO_INDEX": "1", "PIP_FIND_LINKS": "."}.items():
        monkeypatch.setenv(name, value)
    inspection.write_stamp(SOUND)
    with monkeypatch.context() as split_off:
        split_off.setattr(importlib.util, "find_spec", lambda _name: None)
        with pytest.raises(WorkbookError, match="Or, anywhere: install uv"):
            environment.update("environment.txt changed", whole=False)
    assert inspection.STAMP.exists()
    environment.update("environment.txt changed", whole=False)
    now = inspection.inspect()
    assert now
    assert now.versions["cam-probe"] == "1.0"
    assert "pip" in now.versions


def test_no_network_takes_seconds(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A real pip without a package index: a sentence, and nothing half-made."""
    (root / "environment.txt").write_text("no-such-package==1.0\n")
    monkeypatch.setattr(installer, "find_uv", lambda: None)
    use_bundled_pip(monkeypatch)
    with socket.socket() as closed:
        closed.bind(("127.0.0.1", 0))
        index = f"http://127.0.0.1:{closed.getsockname()[1]}/simple"
        for name, value in {
            "PIP_INDEX_URL": index,
            "PIP_FIND_LINKS": "",
            "PIP_EXTRA_INDEX_URL": "",
            "PIP_CONFIG_FILE": os.devnull,
            "PIP_RETRIES": "1",
        }.items():
            monkeypatch.setenv(name, value)
        started = time.monotonic()
        assert commands.run(["setup"]) == 1
    said = capsys.readouterr()
    assert "no connection to the package index" in said.err
    assert "start again" in said.err
    assert "[2/3] Installing" in said.out
    assert not (root / ".venv").exists()
    assert time.monotonic() - started < 30
    Path(said.err.split("said: ")[1].splitlines()[0]).unlink()


def use_bundled_pip(monkeypatch: pytest.MonkeyPatch) -> None:
    """Run pip from the wheel that ensurepip would install, where Python brings it: it is faster."""
    wheel = next(Path(ensurepip.__path__[0]).glob("_bundled/pip-*.whl"), None)
    if wheel:
        with_pip = partial(processes.environ, PYTHONPATH=str(wheel))
        monkeypatch.setattr(processes, "environ", with_pip)
        monkeypatch.setattr(installer, "add_pip", lambda: None)


@pytest.mark.parametrize(("free_mb", "fits"), [(1399, False), (1400, True)])
def test_the_tools_of_the_tests_need_1400_mb(
    free_mb: int, fits: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    room = SimpleNamespace(free=free_mb * 1_000_000)
    monkeypatch.setattr(shutil, "disk_usage", lambda _: room)
    if fits:
        environment.check_disk(environment.MB_FOR_TESTS)
    else:
        with pytest.raises(WorkbookError, match=f"{free_mb} MB are free .* needs 1400 MB"):
            environment.check_disk(environment.MB_FOR_TESTS)
