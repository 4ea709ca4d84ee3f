"""How charts are drawn: classes, curves, insets."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._core import InputError
from ._model import number

# As the program's curves (apps/slapstick/chart_curves_figure.cpp).
CURVE_STYLES = {"LP": (":", "black"), "GR": ("--", "black"), "CH": ("--", "#aa0000"), "SL": ("-.", "black")}
CURVE_STYLES |= {"CO": ("-.", "#aa0000"), "PD": ("-", "black"), "NS": ("-", "#aa0000")}

# As the program's charts (apps/slapstick/chart_colours.hpp).
CLASS_COLOURS = "#2288ee #ff8800 #ffbb88 #004455 #00ccff #774400 #aa66aa #ff2244 #4400bb #550077".split()
KINDS = {"chaotic": "#191919", "quasi-periodic": "#787878", "undecided": "#ffffff", "not admissible": "#e1e1e1", "": "#ffffff"}
OTHERS = "#c8c8c8"


def draw_classes(ax: Any, labels: NDArray[np.str_], extent: tuple[float, ...]) -> None:
    """Ten classes by area, kinds of motion and the others, with their shares."""
    from matplotlib.colors import to_rgb
    from matplotlib.patches import Patch

    names, codes, areas = np.unique(labels, return_inverse=True, return_counts=True)
    order = np.argsort(-areas, kind="stable")
    named = [i for i in order if names[i] not in KINDS][: len(CLASS_COLOURS)]
    colours = [KINDS.get(name, OTHERS) for name in names.tolist()]
    for i, colour in zip(named, CLASS_COLOURS):
        colours[i] = colour
    picture = np.array([to_rgb(colour) for colour in colours])[codes.reshape(labels.shape)]
    ax.imshow(picture, origin="lower", extent=extent, aspect="auto", interpolation="nearest")
    keys = [
        Patch(facecolor=colours[i], edgecolor="black", linewidth=0.4, label=f"{names[i]} {areas[i] / labels.size:.1%}")
        for i in order
        if names[i] and colours[i] != OTHERS
    ]
    others = sum(areas[i] for i in order if colours[i] == OTHERS)
    if others > 0:
        count = colours.count(OTHERS)
        keys.append(Patch(facecolor=OTHERS, edgecolor="black", linewidth=0.4, label=f"{count} others {others / labels.size:.1%}"))
    ax.legend(handles=keys, fontsize="small", frameon=False, loc="upper left", bbox_to_anchor=(1, 1))


def draw_inset(ax: Any, inset: Sequence[float]) -> None:
    """The image of the axes again, enlarged, in the first corner that leaves the inset's rectangle free."""
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    ranges = [number("inset", value) for value in inset]
    if len(ranges) != 4 or not (left <= ranges[0] < ranges[1] <= right and low <= ranges[2] < ranges[3] <= high):
        raise InputError(f"inset: {inset!r} is not (x from, x to, y from, y to) within the chart")
    across = [(value - left) / (right - left) for value in ranges[:2]]
    up = [(value - low) / (high - low) for value in ranges[2:]]
    size, edge = 0.38, 0.06
    for x, y in ((1 - size - edge, 1 - size - edge), (edge, 1 - size - edge), (1 - size - edge, edge), (edge, edge)):
        if across[1] < x or across[0] > x + size or up[1] < y or up[0] > y + size:
            break
    else:
        raise InputError(f"inset: {inset!r} leaves no corner free; ask for a smaller rectangle")
    shown = ax.images[0]
    part = ax.inset_axes([x, y, size, size], xlim=ranges[:2], ylim=ranges[2:])
    part.imshow(shown.get_array(), origin="lower", extent=shown.get_extent(), aspect="auto", cmap=shown.get_cmap(), norm=shown.norm)
    part.set(xlim=ranges[:2], ylim=ranges[2:])
    part.tick_params(labelsize="x-small", labelbottom=y < 0.5, labeltop=y > 0.5, labelleft=x < 0.5, labelright=x > 0.5)
    for label in part.get_xticklabels() + part.get_yticklabels():
        label.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 0.6})
    ax.indicate_inset_zoom(part, edgecolor="black", alpha=1)
