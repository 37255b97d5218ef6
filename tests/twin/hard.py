"""Scenes made to be hard: folds about to be born, the rim at a fold or a landing, k = 1, weak and strong waviness."""

from flint import arb

from gradhesion.twin.curve import Curve
from gradhesion.twin.path import branches, cycle
from gradhesion.twin.roots import extrema, zeros

from .draw import Request, similar


def _request(parameters: dict[str, float], note: str) -> Request:
    return Request("hard", parameters, note)


def tangency(parameters: dict[str, float], wave: int) -> float:
    """The amplitude A at which the tilt touches 0 in the given wave: its least value there falls as A grows."""

    def least(a: float) -> arb:
        curve = Curve(parameters | {"A": a, "a_max_over_R": (wave + 1.2) * parameters["lambda_over_R"]})
        low, high = 2 * arb.pi() * wave, 2 * arb.pi() * (wave + 1)
        values = [curve.tilt(z, curve.fold)[0] for z in extrema(curve, curve.fold, curve.rim) if low < z < high]
        return min(values, key=float, default=arb(1))

    lo, hi = 0.0, parameters["A"]
    while least(hi) > 0:
        lo, hi = hi, 2 * hi
    while (middle := (lo + hi) / 2) not in (lo, hi):
        lo, hi = (middle, hi) if least(middle) > 0 else (lo, middle)
    return hi


def near_tangency() -> list[Request]:
    """Pairs of folds that just exist, and that just do not."""
    made: list[Request] = []
    cases = ((0.0, 0.3, 0.3, 4), (0.55, 0.1, 0.15, 9), (1 - 1e-9, 0.5, 0.4, 3), (1.0, 0.5, 0.2, 7))
    for k, nu, wavelength, wave in cases:
        base = similar(k, nu, 700.0, 0.07, wavelength, 0.4, 1.3 * (wave + 1) * wavelength)
        limit = tangency(base, wave)
        for step in (1e-3, 1e-6, 1e-9, 1e-13):
            for sign in (-1, 1):
                note = f"fold pair in wave {wave}, A off its tangency by {sign * step:g}"
                made.append(_request(base | {"A": limit * (1 + sign * step)}, note))
    return made


def near_rim() -> list[Request]:
    """The rim beside a fold or a landing, and in the middle of jumps."""
    made: list[Request] = []
    for k, nu in ((0.3, 0.2), (1.0, 0.5)):
        base = similar(k, nu, 2500.0, 0.02, 0.25, 0.7, 3.0)
        curve = Curve(base)
        path, rising = cycle(curve)
        middle = len(rising) // 2
        top, bottom = rising[middle].hi, rising[middle].lo
        jump = path.loading[min(1, len(path.loading) - 1)]
        assert top is not None
        places = {"the end of a branch": top, "the start of a branch": bottom, "a landing in loading": jump.end}
        for name, z in places.items():
            rim = float(curve.radius(z))
            made += [
                _request(base | {"a_max_over_R": rim * (1 + step)}, f"rim at {name}, off by {step:g}")
                for step in (-1e-6, 1e-6, -1e-12, 1e-12)
            ]
        for share in (0.3, 0.6):
            rim = float(curve.radius(jump.start + (jump.end - jump.start) * arb(share)))
            made.append(_request(base | {"a_max_over_R": rim}, "rim in the middle of a loading jump"))
    return made


def first_fold(parameters: dict[str, float], share: float) -> Request:
    """A punch smaller than the smallest stable contact."""
    curve = Curve(parameters)
    z = branches(curve, zeros(curve, curve.fold, curve.rim))[0].lo
    rim = share * float(curve.radius(z))
    return _request(parameters | {"a_max_over_R": rim}, f"rim at {share:g} of the first fold")


def hard_scenes() -> list[Request]:
    """All of them, in a fixed order."""
    made = near_tangency() + near_rim()
    for k, share in ((0.0, 0.5), (0.4, 0.01), (0.8, 0.999)):
        made.append(first_fold(similar(k, 0.25, 120.0, 0.3, 0.8, 0.5, 3.0), share))
    for chi in (0.0, 0.05, 0.5, 1.2):
        made.append(_request(similar(1.0, 0.5, 333.0, 0.11, 0.5, chi, 2.5), "k = 1, the contact may shrink to a point"))
    for k, chi in ((0.0, 1.1), (0.35, 1.6), (0.7, 3.0), (0.95, 8.0)):
        made.append(_request(similar(k, 0.15, 900.0, 0.05, 0.3, chi, 2.2), f"weak adhesion, r/s = {chi:g}"))
    for k, nu in ((0.0, 0.3), (0.6, -0.2), (1.0, 0.5)):
        base = similar(k, nu, 5e3, 0.4, 0.2, 0.5, 1.9)
        made += [_request(base | {"A": a}, f"A = {a:g}") for a in (0.0, 1e-12)]
    for k, nu, chi in ((0.0, 0.3, 0.6), (0.45, 0.3, 1.3), (1.0, 0.5, 0.9)):
        made.append(_request(similar(k, nu, 4e3, 0.03, 0.01, chi, 3.0), "300 waves"))
    for k, nu in ((1e-16, 0.3), (1 - 1e-12, 0.5), (2.0**-53, -0.3), (1 - 2.0**-53, 0.5)):
        made.append(_request(similar(k, nu, 60.0, 0.9, 0.4, 0.8, 2.0), f"k = {k!r}"))
    return made
