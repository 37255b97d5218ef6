"""Pictures of fits: of one loop, of several, and of a measured profile."""

import math
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from gradhesion.cli.dataset.select import one_loop
from gradhesion.cli.names.fits import LOOP
from gradhesion.cli.names.outputs import PARAMETER
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.picture.labels import Unit, number, suit, unit_for
from gradhesion.cli.picture.looks import PLAIN, Looks
from gradhesion.cli.picture.pictured import finish, make_room, rename, styled
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.messages import printable
from gradhesion.core.answers.profile_fit import FittedProfile
from gradhesion.core.problem.status import ANOTHER_MINIMUM, POOR_FIT

COLOURS: Final = ("C0", "C3")
"""Of loading and of unloading; of fits, and of those in doubt."""
DOTS: Final[dict[str, Any]] = {"ls": "", "marker": ".", "ms": 2.5, "mew": 0.0, "rasterized": True}
ALONG, UP = "path_indentation_si", "path_load_si"
"""The curves that have the units of depth and load."""
OFFSETS: Final = {
    "indentation_offset": ("offset of the depth", ALONG),
    "load_offset": ("offset of the load", UP),
    "load_slope": ("tilt of the load", "spring_constant"),
}
"""What is fitted beside parameters: its words, and what has its unit."""
FEW: Final = 24
"""Loops that are drawn one by one, with their intervals; of more a histogram is."""
LISTED: Final = 12
"""Loops that have room for the names of their files."""


def drawn_fits(dataset: xarray.Dataset, looks: Looks = PLAIN) -> Figure:
    """Draw a fit, or of several loops a panel for each parameter: values with intervals, or a histogram of many.

    Of several loops one is drawn by itself, `--at loop=FILE` or `--at loop=NUMBER`.
    """
    several = LOOP in dataset.dims
    why = f"fits are drawn as a whole, or one with --at {LOOP}=0" if several else "a fit is drawn as a whole"
    looks.refuse(["over", "variables", "x", "y", "data", "band", "levels", "clabel", *([] if several else ["at"])], why)
    if several and not looks.at:
        looks.refuse(["xlim", "ylim"], why)
        return _draw_loops(dataset, looks)
    return _draw_fit(one_loop(dataset, looks.at) if several else dataset, looks)


def _draw_fit(dataset: xarray.Dataset, looks: Looks) -> Figure:
    """Draw load over depth with the path through the points, and below it the residuals over depth."""
    depth, load, back = (dataset[f"measured_{name}"].values for name in ("indentation", "load", "unloading"))
    along, up, ways = (dataset[f"fitted_{name}"].values for name in ("indentation", "load", "unloading"))
    turn = int(np.count_nonzero(ways <= 0))
    figure = Figure(layout="constrained")
    top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1])
    parts = (("loading", back <= 0, slice(0, turn)), ("unloading", back > 0, slice(turn - 1, None)))
    for colour, (words, own, part) in zip(COLOURS, parts, strict=True):
        top.plot(along[part], up[part], color=colour, lw=0.7, zorder=1.9, label=f"fit, {words}")
        if own.any():
            top.plot(depth[own], load[own], color=colour, **DOTS, label=f"measured, {words}")
            bottom.plot(depth[own], dataset["residual"].values[own], color=colour, **DOTS)
    make_room(top, "x", depth)
    suit(top, "x", ALONG, looks.xlim)
    suit(top, "y", UP, looks.ylim)
    words = "displacement of the machine" if dataset.attrs.get("control") == "machine" else "depth"
    bottom.set(xlabel=top.get_xlabel().replace(r"depth $\delta$", words), ylabel="residual (sd)")
    top.set(xlabel="", ylabel=top.get_ylabel().replace(" $P$", ""))
    if looks.ylabel is not None:  # the residual keeps its own
        rename(top.yaxis, looks.ylabel)
    top.legend()
    bottom.axhline(0.0, color="0.3", lw=0.6)
    rows = zip(*(dataset[name].values.tolist() for name in (PARAMETER, "value", "low", "high")), strict=True)
    caption = [*(in_words(*row) for row in rows), "in brackets 95 % intervals"]
    caption.append(rf"reduced $\chi^2$ = {float(dataset['chi_square']) / int(dataset['degrees_of_freedom']):.3g}")
    finish(figure, dataset, looks.model_copy(update={"ylabel": None}), [top, bottom], caption, size=(4.8, 4.4))
    return figure


def named(name: str, values: Any) -> tuple[str, Unit]:
    """Name what is fitted, with a unit that suits its values.

    >>> words, unit = named("load_slope", [2e-3])
    >>> words, unit.symbol, unit.power
    ('tilt of the load', 'mN/m', -3)
    """
    words, quantity = OFFSETS.get(name, (SYMBOLS.get(name, name), name))
    return words, unit_for(quantity, values)


def in_words(name: str, value: float, low: float, high: float) -> str:
    r"""Write a fitted value and its interval to two digits of the half of that.

    >>> in_words("wavelength", 4.99918e-7, 4.99733e-7, 5.00107e-7), in_words("A", 0.0120055, 0.011965, 0.012046)
    ('$\\lambda$ = 499.92 (499.73 to 500.11) nm', '$A$ = 0.012006 (0.011965 to 0.012046)')
    >>> in_words("load_offset", 8.894e-9, 6.5e-9, 1.13e-8), in_words("work_of_adhesion", 0.03, 0.03, 0.03)
    ('offset of the load = 8.9 (6.5 to 11.3) nN', '$\\Delta\\gamma$ = 30 (30 to 30) mJ/m$^2$')
    """
    words, unit = named(name, value)
    value, low, high = (one / 10.0**unit.power for one in (value, low, high))
    half = 0.5 * (high - low)
    decimals = max(0, 1 - math.floor(math.log10(half))) if 1e-7 <= half < math.inf else None
    ends = [number(one) if decimals is None else f"{one:.{decimals}f}" for one in (value, low, high)]
    written = "{} ({} to {})".format(*ends).replace("-", "\N{MINUS SIGN}")
    return f"{words} = {written} {unit.symbol}".strip()


def _draw_loops(dataset: xarray.Dataset, looks: Looks) -> Figure:
    """Draw a panel for each parameter."""
    names, files = (list(map(str, dataset[name].values)) for name in (PARAMETER, "file"))
    sound = np.flatnonzero(dataset["value"].notnull().all(PARAMETER).values)
    doubts, few = doubtful(dataset)[sound], len(files) <= FEW
    across = 2 if len(names) == 4 else min(3, len(names))
    down = math.ceil(len(names) / across)
    figure = Figure(layout="constrained")
    panels: list[Axes] = []
    for place, name in enumerate(names):
        axes = figure.add_subplot(down, across, place + 1, sharey=panels[0] if few and panels else None)
        panels.append(axes)
        own = dataset[["value", "low", "high"]].isel({PARAMETER: place, LOOP: sound})
        words, unit = named(name, own["value"].values)
        axes.set_xlabel(f"{words} ({unit.symbol})" if unit.symbol else words)
        value, low, high = (own[one].values / 10.0**unit.power for one in own)
        log = value.min() > 0.0 and value.max() > 20.0 * value.min()
        axes.set_xscale("log" if log else "linear")
        if few:
            axes.tick_params(labelleft=place % across == 0)
            ends = np.maximum([value - low, high - value], 0.0)
            for which, colour in ((~doubts, COLOURS[0]), (doubts, COLOURS[1])):
                dots: dict[str, Any] = {"ls": "", "marker": "o", "ms": 3.0, "lw": 0.9, "color": colour}
                axes.errorbar(value[which], sound[which], xerr=ends[:, which], **dots)
        else:
            bins = max(8, min(40, round(1.5 * math.sqrt(value.size))))
            edges: Any = np.histogram_bin_edges(np.log(value) if log else value, bins)
            parts = [value[~doubts], value[doubts]]  # those in doubt on top
            axes.hist(parts, bins=np.exp(edges) if log else edges, stacked=True, color=list(COLOURS))
            axes.axvline(float(np.median(parts[0] if parts[0].size else value)), color="0.2", lw=0.8, ls="--")
        if place % across == 0:
            axes.set_ylabel("loops" if not few else "loop" if len(files) > LISTED else "")
    if few:
        panels[0].set_ylim(len(files) - 0.5, -0.5)  # the first on top
    if len(files) <= LISTED:
        panels[0].set_yticks(range(len(files)), files, fontsize="x-small")
    missing, poor = len(files) - sound.size, int(doubts.sum())
    caption = [counted(sound.size, "loop"), "bars: 95 % intervals" if few else "dashed: median"]
    caption += [f"red: {counted(poor, 'fit')} in doubt"] if poor else []
    caption += [f"{counted(missing, 'loop')} without a fit"] if missing else []
    finish(figure, dataset, looks, panels, caption, size=(2.6 * across + 1.0, 2.2 * down))
    return figure


def doubtful(dataset: xarray.Dataset) -> NDArray[np.bool_]:
    """Say of each loop whether its fit is not to be trusted."""
    flagged = (dataset["status"].values & (POOR_FIT | ANOTHER_MINIMUM)) != 0
    return np.asarray(flagged | (dataset["on_bound"].values > 0).any(axis=1) | (dataset["converged"].values == 0))


def drawn_profile(fit: FittedProfile, name: str) -> Figure:
    """Draw a fitted profile over the distance from the centre: heights, what the power leaves of them, the residual."""
    rho, fine = fit.distance, np.linspace(0.0, fit.distance[-1], 2000)
    heights, model = fit.heights(rho) + fit.residual, fit.heights(fine)
    powers = [one**fit.exponent / (fit.exponent * fit.radius ** (fit.exponent - 1.0)) for one in (rho, fine)]
    rows = (
        ("height (µm)", 1e6 * heights, 1e6 * model),
        ("without the power (nm)", 1e9 * (heights - powers[0]), 1e9 * (model - powers[1])),
        ("residual (nm)", 1e9 * fit.residual, np.zeros(fine.size)),
    )
    with styled():
        figure = Figure(figsize=(4.6, 5.2), layout="constrained")
        panels = figure.subplots(3, 1, sharex=True, height_ratios=[2, 2, 1])
        for axes, (words, points, line) in zip(panels, rows, strict=True):
            axes.plot(1e6 * rho, points, **DOTS, color="0.55", label="measured")
            axes.plot(1e6 * fine, line, color="C3", lw=0.9, label="fit")
            axes.set_ylabel(words)
        panels[0].legend()
        panels[-1].set_xlabel("distance from the centre (µm)")
        words = (
            rf"$m$ = {fit.exponent:.4g}, $R$ = {1e6 * fit.radius:.4g} µm, "
            rf"$\lambda$ = {1e6 * fit.wavelength:.4g} µm, residual {1e9 * fit.residual_rms:.3g} nm rms"
        )
        figure.suptitle(printable(name).replace("$", r"\$") + f"\n{words}")
    return figure
