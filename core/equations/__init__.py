"""The equations of Jin, Guo & Wan (2013) as functions: arrays in, arrays out, broadcasting.

One module a concept: profile.py, pair.py, hertz.py, any_profile.py, jkr.py, stress_intensity.py, pressure.py, gap.py,
general.py, fourier.py, short_waves.py, envelopes.py, effective.py, early_unloading.py, energy.py, saturation.py;
docs/paper.md has a row for every equation, and says where the printed one is corrected (docs/theory.md). Lengths are in
R, loads in 1.5 pi R dgamma, energies in R^2 dgamma, pressures in dgamma/R, and the material is its one number
M R^(1+k)/dgamma, which core/problem/material.py gives from nu, modulus and c0/R. Arguments have one meaning throughout,
which `help` of each function shows. They are for reading, checking and drawing; sweeps of many scenes are for
`gradhesion.core.solve`.
"""
