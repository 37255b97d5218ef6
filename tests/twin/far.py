"""The pull-off force of a long curve in ball arithmetic: of the troughs about a place, and at the rim."""

from collections.abc import Mapping

from flint import arb

from gradhesion.twin.general import Shape
from gradhesion.twin.general.curve import GeneralCurve

SAMPLES = 8
"""Places a shortest wave at which the slope of the load is looked at."""
STEPS = 60


def pull_off_force(parameters: Mapping[str, float], shape: Shape, radius: float, waves: int = 1) -> arb:
    """Return minus the lowest load within some waves of a radius, up to the rim, in 1.5 pi R dgamma.

    Folds of no two nearer than a sample are told apart; beyond those waves the envelope of troughs is not looked at.
    """
    curve = GeneralCurve(parameters, shape)
    turn = 2 * arb.pi()
    centre = (curve.phase(arb(radius)) / turn).mid().floor()
    low, high = turn * (centre - waves), turn * (centre + 1 + waves)
    loads = []
    if curve.rim is not None and curve.rim < high:
        high = curve.rim
        loads.append(curve.force(high))
    step = turn / (SAMPLES * curve.series.shortest)
    z, before = low, curve.tilt(low, curve.trough)[0]
    while z < high:
        beyond = min(high, z + step)
        here = curve.tilt(beyond, curve.trough)[0]
        if before < 0 and here > 0:
            loads.append(curve.force(_zero(curve, z, beyond)))
        z, before = beyond.mid(), here
    lowest = min(loads, key=float)
    return -lowest / (3 * arb.pi() / 2)


def _zero(curve: GeneralCurve, low: arb, high: arb) -> arb:
    """Return where the slope of the load rises through zero: Newton's method in a bracket."""
    z = ((low + high) / 2).mid()
    for _ in range(STEPS):
        value, rate = curve.tilt(z, curve.trough)
        if value > 0:
            high = z
        else:
            low = z
        step = (value / rate).mid()
        if abs(step) < arb(2) ** -100:
            break
        z = (z - step).mid()
        if not (low < z < high):
            z = ((low + high) / 2).mid()
    return z
