"""The names of a study and of its dataset, with what they stand for."""

from typing import Final

PARAMETERS: Final = {
    "k": "gradient exponent k of the modulus E0 (z/c0)^k",
    "nu": "Poisson's ratio",
    "modulus": "reduced modulus E* R/dgamma, with E* = E0/(1 - nu^2)",
    "c0_over_R": "characteristic depth c0/R of the gradient",
    "lambda_over_R": "wavelength lambda/R of the waviness",
    "A": "amplitude over wavelength of the waviness",
    "a_max_over_R": "radius a_max/R of the punch (inf: unbounded)",
}
"""Every parameter in the order of a dataset's dimensions, with its `long_name`."""

OUTPUTS: Final = {
    "pull_off_force": "pull-off force F/(1.5 pi R dgamma)",
    "pull_off_radius": "contact radius a/R at pull-off",
    "dissipated_energy": "energy dissipated in a loading cycle, H/(R^2 dgamma)",
    "loading_jumps": "number of jumps on loading, the jump-in counted",
    "unloading_jumps": "number of jumps on unloading, the jump-out counted",
    "delta_max": "greatest indentation depth delta/R of the cycle",
    "delta_jump_out": "indentation depth delta/R at the jump-out",
}
"""Every output, with its `long_name`."""

STATUS: Final = "what there is to report of a scene (0: nothing)"
"""The `long_name` of `status`."""

SYMBOLS: Final = {
    "k": "$k$",
    "nu": r"$\nu$",
    "modulus": r"$E^{\ast}R/\Delta\gamma$",
    "c0_over_R": "$c_0/R$",
    "lambda_over_R": r"$\lambda/R$",
    "A": "$A$",
    "a_max_over_R": r"$a_{\max}/R$",
    "pull_off_force": r"pull-off force $F\,/\,\frac{3}{2}\pi R\Delta\gamma$",
    "pull_off_radius": "radius at pull-off $a/R$",
    "dissipated_energy": r"dissipated energy $H/R^2\Delta\gamma$",
    "loading_jumps": "jumps on loading",
    "unloading_jumps": "jumps on unloading",
    "delta_max": r"greatest depth $\delta_{\max}/R$",
    "delta_jump_out": r"depth at jump-out $\delta/R$",
    "status": "status",
}
"""Every variable as a picture names it."""

SCENE: Final = "scene"
"""The one dimension of a dataset with `layout = "points"`."""

REFERENCES: Final = (
    "Jin, Guo & Wan (2013), Mechanics of axisymmetric adhesive contact of rough surfaces involving power-law graded "
    "materials; Johnson, Kendall & Roberts (1971), Surface energy and the contact of elastic solids"
)
"""The theory behind the values."""
