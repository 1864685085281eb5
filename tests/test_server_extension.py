"""Every Jupyter server with the package in its environment sends small messages at once."""

import json
import logging
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from jupyter_core.paths import ENV_CONFIG_PATH
from jupyter_server.extension.config import ExtensionConfigManager
from jupyter_server.extension.utils import validate_extension
from jupyter_server.gateway.connections import GatewayWebSocketConnection
from jupyter_server.serverapp import ServerApp
from jupyter_server.services.kernels.connection.channels import ZMQChannelsWebsocketConnection
from traitlets.config import Config

from cammotion.teaching import extension
from cammotion.teaching.server import PromptConnection
from starter import installer

PLAIN_LAB = Path(__file__).parent / "plain_lab.py"
NAME = extension.__name__
SERVERS_OWN = (
    f"{ZMQChannelsWebsocketConnection.__module__}.{ZMQChannelsWebsocketConnection.__name__}"
)


class HubServer(ServerApp):
    """A hub's server is a subclass, too, and its user may name that in the configuration."""


def load(settings: dict[str, Any], **config: Any) -> dict[str, Any]:
    """Load the extension into a server with these settings, and return what they are then."""
    server: Any = HubServer(config=Config(config))  # not started
    server.web_app = SimpleNamespace(settings=settings)
    server.contents_manager = SimpleNamespace(get=None)
    server.session_manager = None
    server.log = logging.getLogger(NAME)
    extension._load_jupyter_server_extension(server)
    return settings


def test_the_servers_own_class_is_replaced(caplog: pytest.LogCaptureFixture) -> None:
    after = load({extension.SETTING: ZMQChannelsWebsocketConnection, "other": 1})
    assert after == {extension.SETTING: PromptConnection, "other": 1}
    assert not caplog.records


@pytest.mark.parametrize(
    "other", [GatewayWebSocketConnection, type("Own", (ZMQChannelsWebsocketConnection,), {})]
)
def test_any_other_class_stays(other: type, caplog: pytest.LogCaptureFixture) -> None:
    """A gateway's, the user's, or that of another extension."""
    assert load({extension.SETTING: other}) == {extension.SETTING: other}
    assert not caplog.records


@pytest.mark.parametrize("section", ["ServerApp", "HubServer"])
def test_the_servers_own_class_stays_where_the_user_names_it(section: str) -> None:
    config = {section: {extension.SETTING: SERVERS_OWN}}
    after = load({extension.SETTING: ZMQChannelsWebsocketConnection}, **config)
    assert after == {extension.SETTING: ZMQChannelsWebsocketConnection}


def test_a_server_without_the_setting_is_left_alone(caplog: pytest.LogCaptureFixture) -> None:
    assert load({"other": 1}) == {"other": 1}
    assert_one_sentence(caplog)


@pytest.mark.parametrize(
    "moved", [ZMQChannelsWebsocketConnection.__module__, PromptConnection.__module__]
)
def test_a_server_without_the_class_is_left_alone(
    moved: str, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It may move within jupyter_server, or change so that ours cannot be made of it."""
    monkeypatch.setitem(sys.modules, moved, None)
    before = {extension.SETTING: ZMQChannelsWebsocketConnection}
    assert load(dict(before)) == before
    assert_one_sentence(caplog)


def assert_one_sentence(caplog: pytest.LogCaptureFixture) -> None:
    """One warning, on one line, without a traceback."""
    (record,) = caplog.records
    said = record.getMessage()
    assert record.levelno == logging.WARNING
    assert record.exc_info is None
    assert "does not know this jupyter_server and leaves it as it is: what the kernel draws" in said
    assert "\n" not in said


def test_a_connection_that_cannot_be_hurried_is_made_all_the_same(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ZMQChannelsWebsocketConnection, "connect", lambda _: "connected")
    connection = PromptConnection.__new__(PromptConnection)  # it has no handler to ask
    connection.log = logging.getLogger(NAME)
    assert connection.connect() == "connected"
    (record,) = caplog.records
    assert "may be 40 ms late" in record.getMessage()


def test_the_environment_switches_it_on() -> None:
    """An editable installation lays the switch there, too."""
    manager = ExtensionConfigManager(read_config_path=ENV_CONFIG_PATH)
    switches = manager.get_jpserver_extensions()  # type: ignore[no-untyped-call]
    assert switches.get(NAME), "not in this environment: python3 workbook.py setup"
    validate_extension(NAME)  # type: ignore[no-untyped-call]


def test_an_update_brings_the_switch(monkeypatch: pytest.MonkeyPatch) -> None:
    """Left to itself, uv passes over an editable package whose pyproject.toml is the old one."""
    ran: list[list[str]] = []
    monkeypatch.setattr(installer, "find_uv", lambda: "uv")
    monkeypatch.setattr(installer, "run", lambda command, _: ran.append(command))
    installer.install_packages("[1/2]", whole=False)
    assert "--reinstall-package cammotion" in " ".join(ran[0])


@pytest.mark.parametrize(
    ("options", "connection"),
    [
        ([], ["PromptConnection", True]),
        (
            [f"--ServerApp.{extension.SETTING}={SERVERS_OWN}"],
            ["ZMQChannelsWebsocketConnection", False],
        ),
    ],
)
def test_a_plain_lab_sends_at_once(
    options: list[str], connection: list[Any], tmp_path: Path
) -> None:
    """TCP_NODELAY on the socket of a real server; not where the user wants the server's way."""
    own = ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR")
    ran = subprocess.run(
        [sys.executable, PLAIN_LAB, *options],
        env=os.environ | {name: str(tmp_path / name) for name in own},
        cwd=tmp_path,
        capture_output=True,
        encoding="utf-8",
        timeout=60,
    )
    assert ran.returncode == 0, ran.stderr
    assert json.loads(ran.stdout) == connection
