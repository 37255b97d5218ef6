"""The answers of one cosine on a paraboloid about its sensitivities (core/face.py)."""

from gradhesion.core import face
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import Cosine, slope
from gradhesion.core.sensitivities import jump_slopes, wave_slopes
from gradhesion.core.types import Table
from gradhesion.core.waves.cosine import branch_of_wave

face.rim_slope.answers(Cosine)(jump_slopes.rim_slope)
face.add_slopes.answers(Cosine)(jump_slopes.add_slopes)
face.add_slopes_to_zero.answers(Cosine)(jump_slopes.add_slopes_to_zero)
face.add_slopes_of_waves.answers(Cosine)(wave_slopes.add_slopes_of_waves)


@face.steepness_at.answers(Cosine)
@kernel()
def steepness_at(table: Table, curve: Cosine, x: float) -> float:
    steepness, _, _, _ = slope(table, curve, 0.5 * (1.0 - table.k), x)
    return steepness


@face.start_of_wave.answers(Cosine)
@kernel()
def start_of_wave(table: Table, curve: Cosine, wave: float) -> tuple[float, float]:
    """Return them by the expansion of the wave."""
    start, level, _, _ = branch_of_wave(table, curve, wave)
    return start, level
