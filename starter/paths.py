"""Where everything is, and what we run on."""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NOTEBOOKS = ROOT / "notebooks"
PACKAGE = ROOT / "src" / "cammotion"
ENVIRONMENT = ROOT / "environment.txt"
PROJECT = ROOT / "pyproject.toml"
ETC = ROOT / "etc" / "jupyter"
# what the package lays into its environment for Jupyter
SERVER_SWITCH = ETC / "jupyter_server_config.d" / "cammotion.json"
LAB_SETTING = ETC / "labconfig" / "default_setting_overrides.d" / "cammotion_lab.json"
VENV = ROOT / ".venv"

ON_WINDOWS = os.name == "nt"
PYTHON_VERSION = "{}.{}".format(*sys.version_info)
VENV_PYTHON = VENV / ("Scripts/python.exe" if ON_WINDOWS else "bin/python")
START = "py workbook.py" if ON_WINDOWS else "python3 workbook.py"


def first_free(path: Path) -> Path:
    """Return the path, or the first of name-2, name-3 ... that does not exist."""
    candidate, number = path, 1
    while os.path.lexists(candidate):
        number += 1
        candidate = path.with_name(f"{path.stem}-{number}{path.suffix}")
    return candidate
