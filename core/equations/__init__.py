"""The equations of Jin, Guo & Wan (2013) as functions: arrays in, arrays out, broadcasting.

    hertz        contact without adhesion over a disc; the integrals of its waves
    jkr          contact with adhesion of a power with one cosine wave
    general      any power and Fourier series: its profile, its contact, the edge as a crack
    quadrature   any smooth profile; the pressure under a punch, and the gap around it
    envelopes    the envelopes of short waves
    effective    the path along them, and the energy lost on it
    short_waves  the leading term of short waves, and where their folds end

docs/paper.md has a row for every equation, and says where the printed one is corrected (docs/theory.md). Lengths are in
R, loads in 1.5 pi R dgamma, energies in R^2 dgamma, pressures in dgamma/R, and the material is its one number
M R^(1+k)/dgamma, which core/problem/material.py gives from nu, modulus and c0/R. Arguments have one meaning throughout,
which `help` of each function shows. They are for reading, checking and drawing; sweeps of many scenes are for
`gradhesion.core.solve`.
"""

import sys

from gradhesion.core.equations import effective, envelopes, general, hertz, jkr, quadrature, short_waves
from gradhesion.core.equations._arguments import describe

# Names of smaller modules that scripts use, also as `import gradhesion.core.equations.gap`.
any_profile = gap = pressure = quadrature
early_unloading = energy = effective
fourier = profile = stress_intensity = general
pair = hertz
saturation = short_waves
for _file in (effective, envelopes, general, hertz, jkr, quadrature, short_waves):
    describe(_file)
    _names = [name for name, module in globals().items() if module is _file and name != "_file"]
    sys.modules |= {f"{__name__}.{name}": _file for name in _names}
