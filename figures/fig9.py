"""Fig. 9: the energy lost in a cycle against the gradient exponent: exact, by C1 + C2, and by the paper's (5.43)."""

import numpy as np
import xarray
from matplotlib.axes import Axes

from figures.curves import Values
from figures.style import DASHES, ENERGY, INK, key, legend, shades
from gradhesion.core.equations import effective, envelopes
from gradhesion.core.problem.material import stiffness

MARKED = np.linspace(0.0, 1.0, 11)
"""The exponents at which (5.43) is marked."""
MARKERS = "osD^v"
TOP = 0.6


def energies(axes: Axes, dataset: xarray.Dataset) -> None:
    """Draw the energy over the exponent for amplitudes and wavelengths, at one Poisson's ratio."""
    lost = dataset["dissipated_energy"]
    waves = [(0.0, float(lost["lambda_over_R"][0]))]
    waves += [(float(A), float(length)) for A in lost["A"][1:] for length in lost["lambda_over_R"]]
    handles = []
    for (A, length), colour, marker in zip(waves, [INK, *shades(len(waves) - 1)], MARKERS, strict=True):
        looks = {"color": colour, "marker": marker, "ms": 2.6, "mfc": "white", "mew": 0.7}
        for solver, dash, wide in (("envelope", "-", 2.2), ("exact", DASHES[1], 1.0)):  # seen below what is upon it
            if A > 0.0 or solver == "envelope":
                line = lost.sel(A=A, lambda_over_R=length, solver=solver)
                axes.plot(line["k"], line, color=colour, ls=dash, lw=wide, alpha=0.35 if solver == "envelope" else 1.0)
        k, fitted = fitted_curve(dataset, A, length)
        axes.plot(k, fitted, ls="none", clip_on=False, zorder=3, **looks)
        handles.append(key(rf"$A = {A:g}$, $\lambda/R = {length:g}$" if A else "$A = 0$", **looks))
    handles += [
        key("$C_1 + C_2$, closed form", color=INK, lw=2.2, alpha=0.35),
        key("exact", color=INK, ls=DASHES[1]),
        key("(5.43), the paper's fits", color=INK, ls="none", marker="o", ms=2.6, mfc="white", mew=0.7),
    ]
    axes.set(xlabel="gradient exponent $k$", ylabel=ENERGY, xlim=(0.0, 1.0), ylim=(0.0, TOP))
    legend(axes, handles=handles, loc="upper center", title=rf"$\nu = {dataset['nu'].item():g}$", alignment="left")


def fitted_curve(dataset: xarray.Dataset, A: float, wavelength: float) -> tuple[Values, Values]:
    """Return (5.43), with the exponents of docs/paper.md, at some exponents; they lie within those of the dataset."""
    k = np.array([k for k in MARKED if k <= dataset["k"].max()])
    material = stiffness(k, *(dataset[name].item() for name in ("nu", "modulus", "c0_over_R")))
    strengths = envelopes.adhesion_strength(k, material), envelopes.waviness_strength(k, wavelength, A)
    turn = float(dataset["a_max_over_a2"].item()) * effective.jump_in_radius(k, *strengths)
    return k, effective.fitted_energy(k, material, wavelength, A, turn)


PICTURES = {"fig9": energies, "extra_energy_exponent": energies}
