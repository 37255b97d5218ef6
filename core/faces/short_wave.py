"""What the leading form of a short wave answers (core/face.py): the path of a cycle, at places z."""

from gradhesion.core import face
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve import short_wave
from gradhesion.core.curve.branches import Trace, ends
from gradhesion.core.curve.short_wave import ShortWave
from gradhesion.core.curve.short_wave_energy import loss_of_jump
from gradhesion.core.types import Work


@face.find_place.answers(ShortWave)
@kernel()
def find_place(_table: tuple[()], curve: ShortWave, level: float, trace: Trace, branch: int) -> float:
    start, _, end, _ = ends(trace, branch)
    return short_wave.find_depth(curve, level, start, end)


@face.loss_between.answers(ShortWave)
@kernel()
def loss_between(_table: tuple[()], curve: ShortWave, start: float, end: float, _work: Work) -> float:
    """Answer at the depth of the place that is left."""
    return loss_of_jump(curve, short_wave.depth(curve, start), start, end)


@face.loss_from_zero.answers(ShortWave)
@kernel()
def loss_from_zero(_table: tuple[()], curve: ShortWave, x: float) -> float:
    return loss_of_jump(curve, 0.0, 0.0, x)


@face.loss_to_zero.answers(ShortWave)
@kernel()
def loss_to_zero(_table: tuple[()], curve: ShortWave, x: float, level: float) -> float:
    return loss_of_jump(curve, level, x, 0.0)


@face.depth_at.answers(ShortWave)
@kernel()
def depth_at(_table: tuple[()], _curve: ShortWave, _x: float, level: float) -> float:
    """Answer that the coordinate is the depth."""
    return level
