"""What a Jupyter server with this package in its environment does for it, however started.

It uses `PromptConnection`, and shows pictures in place of widgets whose kernel is gone.

The server finds this extension by the file that the package lays into its environment's
``etc/jupyter/jupyter_server_config.d``; ``jupyter server extension disable`` switches it off.
"""

from typing import Any

SETTING = "kernel_websocket_connection_class"


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    """Tell the server which module to load: this one."""
    return [{"module": __name__}]


def _load_jupyter_server_extension(server: Any) -> None:
    """Do both, as far as this jupyter_server is one that we know; say what is left undone."""
    for improve, otherwise in (
        (_send_at_once, "what the kernel draws may come 40 ms later"),
        (_show_pictures, "widgets whose kernel is gone show no picture"),
    ):
        try:
            improve(server)
        except Exception as error:
            server.log.warning(
                "cammotion does not know this jupyter_server and leaves it as it is: %s (%r).",
                otherwise,
                error,
            )


def _send_at_once(server: Any) -> None:
    """Put our connection in the place of the server's own; leave any other where it is."""
    # Here, so that a jupyter_server without them is a sentence in the log and no traceback.
    from jupyter_server.services.kernels.connection.channels import ZMQChannelsWebsocketConnection

    from cammotion.teaching.server import PromptConnection

    settings = server.web_app.settings
    if settings[SETTING] is ZMQChannelsWebsocketConnection and not _is_configured(server):
        settings[SETTING] = PromptConnection


def _show_pictures(server: Any) -> None:
    """Leave dead widgets out of what a page is given."""
    from cammotion.teaching.reopening import show_pictures

    show_pictures(server)


def _is_configured(server: Any) -> bool:
    """Tell whether the user names a class, be it the one that the server would take anyway."""
    return any(SETTING in server.config.get(name, ()) for name in server.section_names())
