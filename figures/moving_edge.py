"""Pictures of an edge that opens at more work than it closes at, or at a work that grows with its speed."""

from itertools import groupby
from operator import itemgetter
from typing import Any, Final

import xarray
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator

from figures.curves import dress, plane_of, values_of
from figures.style import DASHES, ENERGY, FORCE, GREY, INK, key, shades

RATIO: Final = r"closing ratio $w_c/\Delta\gamma$"
SPEED: Final = r"speed of the machine $V/v^{\ast}$"
OPENING: Final[dict[str, Any]] = {"color": INK, "lw": 0.8, "zorder": 2.3}
JUMP: Final[dict[str, Any]] = {"lw": 0.8, "ls": (0, (3, 1.5))}
WAVY: Final = {True: "wavy", False: "smooth"}


def closing(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw the loop of each closing ratio: closing in colour, opening black; broad where the edge stays in place."""
    ratios = dataset["closing_ratio"].values
    handles = []
    for ratio, colour in zip(ratios, shades(ratios.size)[::-1], strict=True):
        own = dataset.sel(closing_ratio=ratio)
        x, y = plane_of(own, "path_", "a")
        radius, jump, back = values_of(own, "path_contact_radius", "path_jump", "path_unloading")
        kinds = zip(jump[1:], back[1:], (back[1:] > 0.5) & (radius[1:] == radius[:-1]), strict=True)
        for (jumps, opens, still), run in groupby(enumerate(kinds), key=itemgetter(1)):
            lines = [line for line, _ in run]
            looks = OPENING if opens and not still else {"color": colour, "lw": 3.2 if still else 1.8}
            if jumps:
                looks = looks | JUMP
            axes.plot(x[lines[0] : lines[-1] + 2], y[lines[0] : lines[-1] + 2], **looks)
        handles.append(key(f"{ratio:g}", color=colour, lw=1.8))
    others = [key("opening, all three", **OPENING), key("edge in place", color=GREY, lw=3.2)]
    others.append(key("jump", color=GREY, **JUMP))
    dress(axes, "a")
    axes.add_artist(axes.legend(handles=handles, loc="upper left", title=RATIO, alignment="left"))
    axes.legend(handles=others, loc="lower right")


def split(smooth: Axes, wavy: Axes, dataset: xarray.Dataset) -> None:
    """Draw the three parts of the energy one above the other, for a smooth punch and a wavy one."""
    parts = {"loading_energy": "jumps of loading", "unloading_energy": "jumps of unloading", "front_energy": "edge"}
    top = 1.4 * float(dataset["dissipated_energy"].max())
    for axes, A in zip((smooth, wavy), dataset["A"].values, strict=True):
        own = dataset.sel(A=A)
        ratio = own["closing_ratio"]
        axes.stackplot(ratio, *(own[name] for name in parts), labels=parts.values(), colors=shades(3), lw=0)
        axes.plot(ratio, own["dissipated_energy"], color=INK, label="all")
        axes.set(xlabel=RATIO, ylabel=ENERGY, xlim=(float(ratio.min()), 1.0), ylim=(0.0, top))
        handles, labels = axes.get_legend_handles_labels()
        title = f"{WAVY[bool(A)]}, $A = {A:g}$"
        axes.legend(handles[::-1], labels[::-1], loc="upper right", title=title, alignment="left", ncols=2)


def speed(force: Axes, energy: Axes, dataset: xarray.Dataset) -> None:
    """Draw force and energy over the speed, with the values at rest."""
    for axes, name, label in ((force, "pull_off_force", FORCE), (energy, "dissipated_energy", ENERGY)):
        for A, colour, dash in zip(dataset["A"].values, shades(3)[::2], DASHES[:2], strict=True):
            line = dataset[name].sel(A=A)
            axes.plot(line["speed_over_reference"], line, color=colour, ls=dash, label=f"{WAVY[bool(A)]}, $A = {A:g}$")
        ends = dataset["speed_over_reference"].values[[0, -1]]
        axes.set(xscale="log", yscale="log", xlabel=SPEED, ylabel=label, xlim=ends)
        axes.xaxis.set_major_locator(LogLocator(numticks=5))
        axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.yaxis.set_major_formatter("{x:g}")
        axes.yaxis.set_minor_formatter("")
        axes.legend(loc="upper left")


PICTURES = {"extra_closing": closing, "extra_split": split, "extra_speed": speed}
