"""What the live figures' JavaScript computes, in Node: the same engine as in Chromium, no page."""

import json
import os
import shutil
import subprocess
from base64 import b64decode
from typing import Any

import numpy as np
import pytest

from cammotion.quantities import Floats
from cammotion.views.live import page

_RUNNER = """
const given = %s;
const bare = (key, value) => (Number.isNaN(value) ? "NaN" : value === Infinity ? "Infinity"
  : value === -Infinity ? "-Infinity" : Object.is(value, -0) ? "-0" : value);
const packed = (numbers) => Buffer.from(Float64Array.from(numbers).buffer).toString("base64");
const answer = (() => {%s})();
process.stdout.write(JSON.stringify(answer, bare));
"""


def run(body: str, given: Any = None, more: str = "") -> Any:
    """Return what the body of a JavaScript function returns; `given` is known to it by that name.

    All that the front-end module has is known to it too, and what `more` defines. A number that
    JSON does not have comes back as a text that `float` reads.
    """
    node = shutil.which("node")
    if node is None:
        reason = "NOT TESTED: the JavaScript of the live figures, since node is not on the PATH"
        if os.environ.get("REQUIRE_BROWSER") == "1":
            pytest.fail(reason)
        pytest.skip(reason)
    script = page.module() + more + _RUNNER % (json.dumps(given), body)
    done = subprocess.run(
        [node, "--input-type=module", "-"],
        input=script,
        capture_output=True,
        encoding="utf-8",
        check=False,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def unpacked(text: str) -> Floats:
    """Return the numbers that the script has `packed`."""
    return np.frombuffer(b64decode(text), dtype=np.float64)
