"""Fig. 9: the energy lost in a cycle against the gradient exponent."""

import xarray
from matplotlib.axes import Axes

from figures.style import DASHES, ENERGY, INK, key, shades


def energies(left: Axes, right: Axes, dataset: xarray.Dataset) -> None:
    """Draw the energy over the exponent for amplitudes and wavelengths, a panel for each Poisson's ratio."""
    energy = dataset["dissipated_energy"]
    waves = [(float(A), float(length)) for A in energy["A"][1:] for length in energy["lambda_over_R"]]
    colours = shades(len(waves))
    for axes, nu in zip((left, right), energy["nu"].values, strict=True):
        one = energy.sel(nu=nu)
        base = one.sel(solver="envelope").isel(A=0, lambda_over_R=0)
        axes.plot(base["k"], base, color=INK, lw=1.4)
        for (A, length), colour in zip(waves, colours, strict=True):
            for solver, dash in (("envelope", "-"), ("exact", DASHES[1])):
                line = one.sel(A=A, lambda_over_R=length, solver=solver)
                axes.plot(line["k"], line, color=colour, ls=dash)
        axes.set(xlabel="gradient exponent $k$", ylabel=ENERGY, xlim=(0.0, 1.0))
        axes.set_ylim(0.0, 0.48)
        axes.text(0.04, 0.05, rf"$\nu = {nu:g}$", transform=axes.transAxes)
    handles = [key("$A = 0$", color=INK, lw=1.4)]
    handles += [
        key(rf"$A = {A:g}$, $\lambda/R = {length:g}$", color=colour)
        for (A, length), colour in zip(waves, colours, strict=True)
    ]
    left.legend(handles=handles, loc="upper center")
    right.legend(handles=[key("envelopes (5.43)", color=INK), key("exact", color=INK, ls=DASHES[1])], loc="upper right")


PICTURES = {"fig9": energies}
