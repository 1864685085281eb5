"""A Jupyter server with this package in its environment uses `PromptConnection`, however started.

The server finds this extension by the file that the package lays into its environment's
``etc/jupyter/jupyter_server_config.d``; ``jupyter server extension disable`` switches it off.
"""

from typing import Any

SETTING = "kernel_websocket_connection_class"


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    """Tell the server which module to load: this one."""
    return [{"module": __name__}]


def _load_jupyter_server_extension(server: Any) -> None:
    """Put our connection in the place of the server's own; leave any other where it is."""
    try:
        # Here, so that a jupyter_server without them is a sentence in the log and no traceback.
        from jupyter_server.services.kernels.connection.channels import (
            ZMQChannelsWebsocketConnection,
        )

        from cammotion.teaching.server import PromptConnection

        settings = server.web_app.settings
        if settings[SETTING] is ZMQChannelsWebsocketConnection and not _is_configured(server):
            settings[SETTING] = PromptConnection
    except Exception as error:
        server.log.warning(
            "cammotion does not know this jupyter_server and leaves its connections as they are, "
            "so that a slider may answer 40 ms later (%r).",
            error,
        )


def _is_configured(server: Any) -> bool:
    """Tell whether the user names a class, be it the one that the server would take anyway."""
    return any(SETTING in server.config.get(name, ()) for name in server.section_names())
