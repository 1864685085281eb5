"""The setup check says in words what is missing, out of step or too old."""

from importlib import metadata

import pytest

from cammotion.teaching.setup_check import check_setup, setup_problems


def with_version(package: str, version: str | None) -> list[str]:
    def installed(name: str) -> str:
        if name != package:
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
    assert "The package jupyterlab_widgets is" in said
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
