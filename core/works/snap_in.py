"""The pull just after the jump into contact, on the curve of closing.

The jump starts from zero contact at the coordinate 0 and ends at the radius a on the closing curve, or at the rim,
where the contact is pinned: P = K [a^(1+k) depth - I(a)] (docs/theory.md, section 13).
"""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gradhesion.core.arrays.prepared import curves_of, prepared, run_by_exponent
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.compiler.marks import note_compiled
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, curve_at, rims_of, state
from gradhesion.core.problem.curves import GeneralCurves
from gradhesion.core.problem.names import PATTERN
from gradhesion.core.sweep import How, solve
from gradhesion.core.types import Floats
from gradhesion.core.works.cycle import LEAST, closing_parameters

_LANDED: Final = 1e-6
"""The coordinate where a jump at the coordinate 0 ends, over its terms, is below this: it is 0 but for rounding."""


@kernel()
def fill_pulls(basis: Basis, curves: GeneralCurves, out: Floats) -> None:
    """Put the pulls at the coordinate 0 of contacts up to the rims of curves into `out`, of shape (curves, rims).

    They are in 1.5 pi R dgamma. The rims are radii of contact. NaN where the jump from the coordinate 0 through a
    machine does not end there: on the curve the coordinate is above 0.
    """
    for i in curves.numbers:
        made = curve_at(basis, curves, i)
        waves, curve = Basis(basis.table, made.cosine_bins, made.series), made.curve
        rims = rims_of(curves, i)
        for rim in range(rims.size):
            _, _, front, depth, load = state(waves, curve, rims[rim] / made.wavelength)
            level = curve.alpha * depth + curve.beta * load
            size = abs(curve.alpha * depth) + abs(curve.beta * load)
            if curve.beta > 0.0 and level > _LANDED * size:
                continue
            load -= front * level / (curve.alpha + curve.beta * front)
            out[i, rim] = -force_unit(basis.table.k, made.length, made.depth) * load


def snap_in_force(scenes: Mapping[str, ArrayLike], ratio: NDArray[np.float64], how: How) -> NDArray[np.float64]:
    """Return the pulls in 1.5 pi R w_o, of the broadcast shape: 0 under load control, NaN at ratio 0.

    Negative where waves press at the depth 0, so that the contact is not one disc; by a machine NaN there.

    Parameters
    ----------
    scenes
        Their parameters, without the ratio.
    ratio
        w_c/w_o, which broadcasts with them.
    how
        How they are solved.
    """
    shape = np.broadcast_shapes(ratio.shape, *(np.shape(value) for value in scenes.values()))
    if how.loading.control == "load":
        return np.where(np.broadcast_to(ratio, shape) > 0.0, 0.0, np.nan)
    closing = {name: value for name, value in closing_parameters(scenes, ratio).items() if name != "load_max"}
    start = closing | {"indentation_max_over_R": 0.0}
    known: dict[str, Any] = {"threads": how.threads, "profile": how.profile, "loading": how.loading}
    known |= {"toughness": how.toughness}
    radius = solve(start, ["turning_radius"], check_contact=False, **known)["turning_radius"]
    pulls = np.maximum(ratio, LEAST) * pulls_at(closing | {"a_max_over_R": radius}, how)
    if how.loading.control == "machine":  # the depth is not 0 there where the punch is pressed
        pulls = np.where(pulls < 0.0, np.nan, pulls)
    return np.where(ratio > 0.0, pulls, np.nan)


def pulls_at(scenes: Mapping[str, ArrayLike], how: How) -> NDArray[np.float64]:
    """Return the pulls in 1.5 pi R dgamma of contacts up to a_max at the coordinate 0, of the broadcast shape."""
    plain = {name: value for name, value in scenes.items() if name not in PATTERN}  # no effect at the depth 0
    found = prepared(plain, how.loading)
    series, curves_at = curves_of(found, how.profile)
    out = np.full((found.k.size, found.rim.shape[1]), np.nan)

    def work(exponent: float, index: NDArray[np.int64], interpolated: bool) -> None:
        basis = Basis(*tables_of(exponent, series, interpolated=interpolated), series)
        fill_pulls(basis, curves_at(exponent, index), out)

    run_by_exponent(found.k, work, how.threads, found.rim.shape[1])
    note_compiled("edge")
    return out.reshape(found.shape)
