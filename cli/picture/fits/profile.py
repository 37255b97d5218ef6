"""A picture of a fitted profile: measured heights with the fit, what the power leaves with the waves, the residual."""

import numpy as np
from matplotlib.figure import Figure

from gradhesion.cli.picture.pictured import styled
from gradhesion.cli.terminal.printable import printable
from gradhesion.core.answers.profile_fit import FittedProfile

MEASURED = "0.55"
FITTED = "C3"


def drawn_profile(fit: FittedProfile, name: str) -> Figure:
    """Draw a fit over the distance from the centre."""
    rho = fit.distance
    model = fit.heights(rho)
    power = rho**fit.exponent / (fit.exponent * fit.radius ** (fit.exponent - 1.0))
    fine = np.linspace(0.0, rho[-1], 2000)
    waves = fit.heights(fine) - fine**fit.exponent / (fit.exponent * fit.radius ** (fit.exponent - 1.0))
    with styled():
        figure = Figure(figsize=(4.6, 5.2), layout="constrained")
        top, middle, bottom = figure.subplots(3, 1, sharex=True, height_ratios=[2, 2, 1])
        dots = {"ls": "", "marker": ".", "ms": 2.0, "color": MEASURED, "rasterized": True}
        top.plot(1e6 * rho, 1e6 * (model + fit.residual), **dots, label="measured")
        top.plot(1e6 * fine, 1e6 * fit.heights(fine), color=FITTED, lw=0.9, label="fit")
        top.set_ylabel(r"height ($\mu$m)")
        top.legend()
        middle.plot(1e6 * rho, 1e9 * (model + fit.residual - power), **dots)
        middle.plot(1e6 * fine, 1e9 * waves, color=FITTED, lw=0.9)
        middle.set_ylabel("without the power (nm)")
        bottom.plot(1e6 * rho, 1e9 * fit.residual, **dots)
        bottom.axhline(0.0, color=FITTED, lw=0.6)
        bottom.set_ylabel("residual (nm)")
        bottom.set_xlabel(r"distance from the centre ($\mu$m)")
        words = (
            rf"$m$ = {fit.exponent:.4g}, $R$ = {1e6 * fit.radius:.4g} $\mu$m, "
            rf"$\lambda$ = {1e6 * fit.wavelength:.4g} $\mu$m, residual {1e9 * fit.residual_rms:.3g} nm rms"
        )
        figure.suptitle(printable(name).replace("$", r"\$") + f"\n{words}")
    return figure
