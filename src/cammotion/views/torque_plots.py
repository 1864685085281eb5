"""Pictures of what an indexer takes: torque and power, from stop to stop."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from cammotion.arguments import checked
from cammotion.hardware.indexer import Indexer
from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.quantities import Floats, InputError, one_of
from cammotion.views.corners import corners, within_short_pieces
from cammotion.views.law_plots import EVEN, from_rest_to_rest
from cammotion.views.names import TITLE, add_legend_below, by_name, columns_below, name_line
from cammotion.views.pictures import on_paper
from cammotion.views.plots import style_line, styled

QUANTITIES = {"torque": "torque on the table in N m", "power": "power in W"}
_COLUMNS, _FEW_ROWS, _ROW_INCHES = 2, 3, 0.2  # of the legend
_CLOSE = 33  # places of a short ramp


@checked
@on_paper
def plot_torque(
    indexers: Mapping[str, Indexer], *, quantity: str = "torque", ax: Axes | None = None
) -> Axes:
    """Draw the torque of each indexer over x = t/tm, from rest to rest, and return the Axes.

    `indexers` are drawn by their names; `quantity` is "torque" in N m or "power" in W. A torque
    that is there at once is drawn as the jump that it is. Raises InputError for no indexer, and
    for another quantity.

    >>> import cammotion as cm
    >>> plot_torque({"table": cm.Indexer(38.5, stops=8, time_s=0.75)}).get_ylabel()
    'torque on the table in N m'
    """
    if not indexers:
        raise InputError(
            "There is no indexer to draw: give each by its name, for example "
            '{"table": Indexer(38.5, stops=8, time_s=0.75)}.'
        )
    quantity = one_of("quantity", quantity, QUANTITIES)
    called = by_name(indexers, TITLE)
    rows = -(-len(called) // columns_below(called.values(), _COLUMNS))
    height = 4.2 + _ROW_INCHES * max(rows - _FEW_ROWS, 0)
    ax = styled(ax, "x = t/tm", QUANTITIES[quantity], (7.5, height), layout="constrained")
    for number, (name, indexer) in enumerate(indexers.items()):
        places = _places(as_law(indexer.law))
        values = (indexer.torque_N_m if quantity == "torque" else indexer.power_W)(places)
        line = ax.plot(*from_rest_to_rest(places, values))[0]
        name_line(style_line(line, number), called[name], name)
    ax.axhline(0, color="#000000", linewidth=0.8)
    ax.margins(x=0)
    add_legend_below(ax, _COLUMNS)
    return ax


def _places(law: MotionLaw) -> Floats:
    """Return x with each peak of the torque among them, and close enough for the power's."""
    close = within_short_pieces(law.curve, _CLOSE)
    return np.union1d(EVEN, np.concatenate([corners(law.curve.derived(2)), close]))
