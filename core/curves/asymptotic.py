"""The asymptotic curve of short waves, (5.15)-(5.20)."""

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, curve_of
from gradhesion.core.curve.short_wave import ShortWave, folds_within, waves_of
from gradhesion.core.curves import general
from gradhesion.core.curves.equilibrium import draw_named
from gradhesion.core.curves.forms import General, general_numbers
from gradhesion.core.curves.knots import MOST_FOLDS
from gradhesion.core.curves.smooth import draw_smooth
from gradhesion.core.curves.subject import Form, Subject
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.shape import depth_factor_of, rows_of


def draw_asymptotic(subject: Subject, profile: Profile) -> dict[str, NDArray[np.float64]] | None:
    """Return the asymptotic curve from zero contact to the end of the drawn range, None if it folds too often.

    The scene is any under displacement control; with A = 0 the curve is that of the smooth punch. The variables are
    `asymptotic_...` (draw.CURVES). Depth includes the mean height that the printed form drops, lambda A of one cosine.
    The form is not valid where the contact is no larger than a wave.
    """
    if subject.mean_height == 0.0:
        smooth = general.draw_smooth if isinstance(subject.exact.numbers, General) else draw_smooth
        return {name.replace("smooth", "asymptotic"): values for name, values in smooth(subject).items()}
    k, m, wavelength = subject.k, profile.exponent, subject.wavelength
    table, amplitude = subject.table, subject.mean_height / wavelength
    exact, length, unit = curve_of(k, m, depth_factor_of(k, m), subject.stretch, wavelength, amplitude, 0.0)
    series = rows_of(profile)
    basis, by_depth = Basis(table, *waves_of(table, series)), ShortWave(*exact)
    by_load, end = by_depth._replace(alpha=0.0, beta=1.0), subject.end / wavelength
    found = [folds_within(basis, curve, end) for curve in (by_depth, by_load)]
    if not all(0 <= count <= MOST_FOLDS for count, _, _ in found):
        return None
    places = np.unique(np.concatenate([zeros[:count] for count, _, zeros in found]))
    numbers = general_numbers(k, by_depth, float(table["amplitude"]), series)
    form = Form(basis, numbers, wavelength, unit, force_unit(k, length, unit))
    return draw_named(subject, form, places[places < end], "asymptotic")
