"""The setup check says in words what is missing, out of step, too old, broken or hidden."""

import importlib
import json
import subprocess
import sys
from collections.abc import Callable
from importlib import metadata
from pathlib import Path
from types import ModuleType

import pytest

import cammotion
from cammotion.teaching import setup_check
from cammotion.teaching.setup_check import check_setup, setup_problems

ROOT = Path(__file__).parent.parent
SERVER = "jupyter_server"


@pytest.fixture(autouse=True)
def at_home(monkeypatch: pytest.MonkeyPatch) -> None:
    """Be in the workbook's own environment, wherever the tests run."""
    be_at_home(monkeypatch, True)


def be_at_home(monkeypatch: pytest.MonkeyPatch, answer: bool) -> None:
    monkeypatch.setattr(setup_check, "_is_at_home", lambda: answer)


def be_without(monkeypatch: pytest.MonkeyPatch, *packages: str) -> None:
    """Let packages not be installed."""
    version, requires = metadata.version, metadata.requires

    def find(name: str) -> str:
        if name in packages:
            raise metadata.PackageNotFoundError(name)
        return version(name)

    def ask(name: str) -> list[str] | None:
        find(name)
        return requires(name)

    monkeypatch.setattr(metadata, "version", find)
    monkeypatch.setattr(metadata, "requires", ask)


def with_version(package: str, version: str | None) -> list[str]:
    def installed(name: str) -> str:
        if name.replace("-", "_") != package:
            return metadata.version(name)
        if version is None:
            raise metadata.PackageNotFoundError(name)
        return version

    return setup_problems(installed)


def test_this_environment_is_whole(capsys: pytest.CaptureFixture[str]) -> None:
    check_setup()
    assert capsys.readouterr().out == "Everything the workbook needs is here.\n"


def test_a_missing_package_is_named() -> None:
    first, last = with_version("sympy", None)
    assert first == "The package sympy is missing; cammotion needs it."
    assert "python3 workbook.py" in last


def test_what_the_lab_needs_belongs_to_it() -> None:
    assert with_version("jupyterlab", "3.6.0")


@pytest.mark.parametrize("version", [None, "1.0.0", "99.0"])
def test_jupyterlab_widgets_missing_or_out_of_step(version: str | None) -> None:
    said = " ".join(with_version("jupyterlab_widgets", version))
    assert "The package jupyterlab_widgets is" in said.replace("jupyterlab-", "jupyterlab_")
    assert "ipywidgets needs" in said
    assert "sliders" in said


def test_an_old_version_is_named_with_what_is_needed() -> None:
    (sentence, _) = with_version("numpy", "1.26.4")
    assert "numpy is here in version 1.26.4, but cammotion needs" in sentence
    assert ">=2.1" in sentence


def test_an_old_python() -> None:
    assert "This is Python 3.10; the workbook needs 3.11 or later." in setup_problems(
        python=(3, 10)
    )


def test_without_ipywidgets_it_is_said_and_no_traceback(monkeypatch: pytest.MonkeyPatch) -> None:
    be_without(monkeypatch, "ipywidgets")
    first, _ = setup_problems(metadata.version)
    assert first == "The package ipywidgets is missing; cammotion needs it."


@pytest.mark.parametrize(
    "error", [ImportError("DLL load failed: blocked"), AttributeError("_ARRAY_API"), OSError("")]
)
def test_what_is_installed_and_broken_is_named(error: Exception) -> None:
    """Its version alone would vouch for it."""

    def load(name: str) -> ModuleType:
        if name == "scipy.optimize":
            raise error
        return importlib.import_module(name)

    first, last = setup_problems(load=load)
    assert first.startswith("The package scipy cannot be imported")
    assert str(error) in first
    assert "workbook.py" in last


def run_check(folder: Path, **variables: str) -> str:
    """Run the check as a kernel in this folder would, and return what it prints."""
    code = "import sys; sys.path.insert(0, ''); import cammotion; cammotion.check_setup()"
    command = [sys.executable, "-c", code]
    path = {"PYTHONPATH": str(ROOT / "src"), "PATH": "", "SYSTEMROOT": "", "HOME": str(folder)}
    ran = subprocess.run(
        command, cwd=folder, env=path | variables, capture_output=True, text=True, check=True
    )
    return ran.stdout


def test_a_file_that_hides_a_package_is_found(tmp_path: Path) -> None:
    """A learner's own file beside the notebook, or a folder in PYTHONPATH."""
    assert run_check(tmp_path) == "Everything the workbook needs is here.\n"
    mine, other = tmp_path / "mine", tmp_path / "other"
    for folder in (mine, other):
        folder.mkdir()
    (mine / "mpmath.py").write_text("pi = 3")
    (other / "ezdxf").mkdir()
    (other / "ezdxf" / "__init__.py").write_text("")
    said = run_check(mine, PYTHONPATH=f"{other}:{ROOT / 'src'}")
    assert f"mpmath is installed, but hidden by {(mine / 'mpmath.py').resolve()}" in said
    assert f"hidden by {(other / 'ezdxf').resolve()}" in said
    assert "PYTHONPATH" in said


def test_another_cammotion_than_the_installed_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """One that is only found on the path, or that is older than what is installed."""
    monkeypatch.setattr(cammotion, "__version__", "0.0.9")
    first, _ = setup_problems()
    assert first.startswith(f"cammotion 0.0.9 is imported from {Path(cammotion.__file__).parent}")
    assert f"but {metadata.version('cammotion')} is installed" in first
    be_without(monkeypatch, "cammotion")
    first = setup_problems(metadata.version)[0]
    assert "and is not installed" in first
    assert "PYTHONPATH" in first


def test_elsewhere_no_lab_is_asked_for_and_pip_is_what_mends(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A Notebook 7 or a hub brings what it needs itself; with ipywidgets 7 two are named."""
    be_at_home(monkeypatch, False)
    assert with_version("jupyterlab", None) == with_version("ipykernel", None) == []
    first, second, last = with_two({"ipywidgets": "7.8.5", "numpy": "1.26.4"})
    assert first.startswith("The package ipywidgets is here in version 7.8.5, but cammotion needs")
    assert second.startswith("The package numpy is here")
    assert last.startswith('Run `%pip install "ipywidgets')
    assert '" "numpy<3,>=2' in last
    assert "workbook.py" not in last
    check_setup()
    assert capsys.readouterr().out == "Everything the workbook needs is here.\n"


def be_in_colab(monkeypatch: pytest.MonkeyPatch) -> None:
    be_at_home(monkeypatch, False)
    monkeypatch.setitem(sys.modules, "google.colab", ModuleType("google.colab"))


def load_as(versions: dict[str, str]) -> Callable[[str], ModuleType]:
    """Return an import of modules that were loaded in these versions."""

    def load(name: str) -> ModuleType:
        module = importlib.import_module(name)
        if name not in versions:
            return module
        loaded = ModuleType(name)
        vars(loaded).update(__file__=module.__file__, __version__=versions[name])
        return loaded

    return load


def test_colab_has_what_its_page_shows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Versions of August 2026; its jupyterlab_widgets does not fit, and shows nothing there."""
    be_in_colab(monkeypatch)
    old = {"ipywidgets": "7.7.1", "matplotlib": "3.10.0", "jupyterlab_widgets": "99.0"}

    def installed(name: str) -> str:
        return old.get(name) or metadata.version(name)

    assert setup_problems(installed, load=load_as(old)) == []


def test_colab_with_ipywidgets_8_is_told_to_go_back(monkeypatch: pytest.MonkeyPatch) -> None:
    be_in_colab(monkeypatch)
    first, last = setup_problems()
    assert first.startswith("The package ipywidgets is here in version 8.")
    assert last.startswith('Run `%pip install "ipywidgets<8,>=7.7.1"` in a cell and restart')


def test_what_was_installed_since_it_was_loaded_asks_for_a_restart() -> None:
    """As after a %pip in a running notebook: explorers fail there with words of Python's."""
    first, *_ = setup_problems(load=load_as({"ipywidgets": "7.7.1"}))
    installed = metadata.version("ipywidgets")
    assert first == (
        f"The package ipywidgets is loaded in version 7.7.1, and {installed} is installed since: "
        "restart the kernel."
    )


def with_two(versions: dict[str, str]) -> list[str]:
    return setup_problems(lambda name: versions.get(name) or metadata.version(name))


def test_what_a_server_elsewhere_has_is_not_vouched_for(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The kernel of a hub has no server; a plain Python, into which a wheel went, no Jupyter."""
    be_at_home(monkeypatch, False)
    be_without(monkeypatch, SERVER, "jupyterlab", "jupyterlab_widgets", "widgetsnbextension")
    monkeypatch.setitem(sys.modules, "ipykernel", ModuleType("ipykernel"))
    assert setup_problems(metadata.version) == []
    check_setup()
    well, remark = capsys.readouterr().out.splitlines()
    assert well == "Everything the workbook needs is here."
    assert "another environment than this kernel" in remark
    assert "jupyterlab_widgets is missing there" in remark
    monkeypatch.delitem(sys.modules, "ipykernel")
    check_setup()
    assert "no Jupyter in this environment" in capsys.readouterr().out.splitlines()[1]


def test_a_package_that_its_author_works_on_may_lie_anywhere(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """An editable installation is no file that hides a package."""
    (tmp_path / "mpmath.py").touch()
    mine = ModuleType("mpmath")
    mine.__file__ = str(tmp_path / "mpmath.py")

    def load(name: str) -> ModuleType:
        return mine if name == "mpmath" else importlib.import_module(name)

    assert "hidden by" in setup_problems(load=load)[0]
    distribution = metadata.distribution

    class Editable:
        """The package as pip -e leaves it."""

        version = metadata.version("mpmath")

        def read_text(self, _name: str) -> str:
            return json.dumps({"dir_info": {"editable": True}})

    monkeypatch.setattr(
        metadata,
        "distribution",
        lambda name: Editable() if name == "mpmath" else distribution(name),
    )
    assert setup_problems(load=load) == []
