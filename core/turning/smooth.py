"""Where the cycle of a smooth punch turns, at a depth or at a load, in closed form or by Newton's method."""

import math
from typing import Final

from gradhesion.core.closed import smooth
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, NO_VALUE
from gradhesion.core.turning.turns import Turns

_STEPS: Final = 200


@kernel()
def turn_smooth(k: float, stretch: float, turns: Turns) -> None:
    """Turn a smooth punch of stretch s, all its rims, in closed form (closed/smooth.py); lengths are in R."""
    rims, targets, by_load, _, radii, flags = turns
    length = smooth.smooth_length(k, stretch)
    depth_scale = 2.0 * length * length / (1.0 + k)
    z_in = 2.0 ** (2.0 / (3.0 + k))
    for i in range(rims.size):
        if not has_value(rims[i], targets[i], by_load):
            radii[i], flags[i] = math.nan, NO_VALUE
            continue
        if by_load:
            half = 0.5 * (3.0 + k)
            abscissa = half * (1.0 + math.sqrt(1.0 + 2.0 * targets[i] / (smooth.FORCE_SCALE * half)))
            z = abscissa ** (1.0 / half)
        else:
            target = targets[i] / depth_scale
            if abs(target) <= CLOSE:
                flags[i] |= CLOSE_TO_A_JUMP
            if target < 0.0:
                radii[i] = 0.0
                continue
            z = z_in + math.sqrt(2.0 * target)
            for _ in range(_STEPS):
                power = z ** (0.5 * (1.0 - k))
                step = (0.5 * z * z - power - target) / (z - 0.5 * (1.0 - k) * power / z)
                z -= step
                if not step > 1e-16 * z:
                    break
            z = max(z, z_in)
        radii[i] = min(rims[i], z * length)


@kernel()
def has_value(rim: float, target: float, by_load: bool) -> bool:
    """Return whether rim and target are in their ranges."""
    return rim > 0.0 and abs(target) < math.inf and (target > 0.0 or not by_load)
