"""The answers of the leading form of short waves (core/face.py) that differ from those of any profile (series.py)."""

import numpy as np

from gradhesion.core import face
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, level_at
from gradhesion.core.curve.general_energy import energy_from_zero
from gradhesion.core.curve.panels import PLACES, SHARES, panel_outwards
from gradhesion.core.curve.short_wave import MOST_WAVES, ShortWave
from gradhesion.core.harmonics.series import highest_harmonic
from gradhesion.core.numbers.circle import TWO_PI, sine_cosine_of_turns
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Harmonics, Work


@kernel(contract=True, inline=True)
def _waves(rows: Harmonics, x: float) -> tuple[float, float, float]:
    """Return S and its first two derivatives by z at x; `rows` are those of `waves_of` (curve/short_wave.py)."""
    height, slope, bow = 0.0, 0.0, 0.0
    for i in range(rows.shape[0]):
        n = rows[i, 0]
        sine, cosine = sine_cosine_of_turns(n * x)
        wave = rows[i, 1] * sine + rows[i, 2] * cosine
        height += wave
        slope += n * (rows[i, 1] * cosine - rows[i, 2] * sine)
        bow -= n * n * wave
    return height, slope, bow


@face.waves_at.answers(ShortWave)
@kernel(contract=True)
def waves_at(basis: Basis, curve: ShortWave, x: float, whole: float) -> tuple[float, float, float, float]:
    """Return v of the depth or of the load, whichever is prescribed."""
    table, mean, rows = basis
    c = 0.5 * (1.0 - table.k)
    level = level_at(table.k, curve.alpha, curve.beta)
    z = TWO_PI * (whole + x)
    height, slope, bow = _waves(rows, x)
    power, inverse = amplitude_power(table, z), 1.0 / z
    rate = z * slope
    return (
        mean * inverse + power * height,
        power * height,
        power * (level * height + rate),
        power * inverse * ((c - 1.0) * level * height + (level + c) * rate + z * z * bow),
    )


@face.depth_of_point.answers(ShortWave)
@kernel()
def depth_of_point(basis: Basis, curve: ShortWave) -> float:
    return -1.0 if basis.table.k == 1.0 else curve.gain * basis.cosine_bins


@kernel(contract=True)
def _excess(basis: Basis, curve: ShortWave, x: float) -> tuple[float, float]:
    """Return depth_H less the mean height, and z^c."""
    B, m, g, _, _ = curve
    z = TWO_PI * x
    height, _, _ = _waves(basis.series, x)
    stretch = z * amplitude_power(basis.table, z)
    return (B * z * z if m == 2.0 else B * z**m) + g * stretch * height, stretch


@kernel()
def _from_zero(basis: Basis, curve: ShortWave, x: float, level: float) -> float:
    """Return the energy of the jump from zero contact to x; of a point none.

    Where more waves stand within x than are walked, folds stand near x alone, so that all these waves are below 1/z of
    adhesion: only their mean height is integrated, which leaves 1e-12.
    """
    table, mean, rows = basis
    if x * highest_harmonic(rows) > MOST_WAVES:
        rows = np.zeros((0, 3))
    return energy_from_zero(Basis(table, mean, rows), curve, x, level)


@face.loss_between.answers(ShortWave)
@kernel()
def loss_between(basis: Basis, curve: ShortWave, start: float, end: float, _work: Work) -> float:
    """Return it by Gauss's rule in panels."""
    far, stretch = _excess(basis, curve, start)
    if end == 0.0:
        return -_from_zero(basis, curve, start, far - stretch + curve.gain * basis.cosine_bins)
    shortest = highest_harmonic(basis.series)
    total, low, high = 0.0, min(start, end), max(start, end)
    while low < high:
        width, beyond, first, last = panel_outwards(low, high, 0.0, shortest)
        part = 0.0
        for i in range(first, last):
            x = low + width * PLACES[i]
            here, scale = _excess(basis, curve, x)
            rho = (here - (far - stretch)) / scale
            part += SHARES[i] * x * (1.0 - rho) * (1.0 + rho)
        total += width * part
        low = beyond
    return total * TWO_PI * TWO_PI * (1.0 if end > start else -1.0)


@face.loss_from_zero.answers(ShortWave)
@kernel()
def loss_from_zero(basis: Basis, curve: ShortWave, x: float) -> float:
    return _from_zero(basis, curve, x, 0.0)


@face.loss_to_zero.answers(ShortWave)
@kernel()
def loss_to_zero(basis: Basis, curve: ShortWave, x: float, level: float) -> float:
    return -_from_zero(basis, curve, x, level)
