"""A scene on a patterned interface made ready for drawing, as curves/general.py."""

import math
from collections.abc import Mapping

import numpy as np

from gradhesion.core.arrays.prepared import curves_of, prepared
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, curve_at
from gradhesion.core.curves.forms import General, general_numbers
from gradhesion.core.curves.general import end_of, trace_of
from gradhesion.core.curves.subject import Form, Subject
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.toughness import Toughness


def subject_of(scene: Mapping[str, float], profile: Profile, loading: Loading, toughness: Toughness) -> Subject | None:
    """Return a scene (the parameters of `solve`) ready for drawing, None where one is outside its range."""
    scenes = prepared(scene, loading, toughness=toughness)
    k, rim = float(scenes.k[0]), float(scenes.rim[0, 0])
    if not 0.0 <= k <= 1.0:
        return None
    series, curves_at = curves_of(scenes, profile, toughness)
    table, cosine_bins = tables_of(k, series)
    curves = curves_at(k, np.zeros(1, dtype=np.int64))
    made = curve_at(Basis(table, cosine_bins, series), curves, 0)
    if not (made.valid and 0.0 < rim <= curves.patterns.limit[0]):
        return None
    curve, wavelength, length, unit = made.curve, made.wavelength, made.length, made.depth
    pattern, finest = made.cosine_bins, made.series
    basis = Basis(table, pattern, finest)
    _, half, ripple = general_numbers(k, curve._replace(gain=pattern.gain), float(table["amplitude"]), pattern.waves)
    numbers = General(curve, min(half, 0.5 / finest[0, 0]), ripple + max(pattern.most - 1.0, 1.0 - pattern.least))
    form = Form(basis, numbers, wavelength, unit, force_unit(k, length, unit))
    trace, others = trace_of(basis, curve, rim / wavelength)
    end = rim if rim < math.inf else end_of(form, trace, others)
    stretch, mean = float(scenes.stretch[0]), float(scenes.amplitude[0] * scenes.wavelength[0])
    return Subject(table, stretch, wavelength, math.nan, mean, rim, end, form, trace, others)
