"""The asymptotic curve of short waves, (5.15)-(5.20)."""

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curve.short_wave import ShortWave
from gradhesion.core.curves.equilibrium import draw_named
from gradhesion.core.curves.forms import SHORT
from gradhesion.core.curves.knots import folds_of_wave
from gradhesion.core.curves.smooth import smooth_places
from gradhesion.core.curves.subject import Form, Subject, wavy_form
from gradhesion.core.struve.circle import TWO_PI


def draw_asymptotic(subject: Subject) -> dict[str, NDArray[np.float64]] | None:
    """Return the asymptotic curve from zero contact to the end of the drawn range, None if it folds too often.

    Parameters
    ----------
    subject
        Any scene. With A = 0 the curve is that of the smooth punch.

    Returns
    -------
    The variables `asymptotic_...` (draw.CURVES). Depth holds the mean height lambda A that the printed form drops.
    Nothing is claimed where the contact is no larger than a wave.
    """
    k = subject.k
    if subject.chi == 0.0:
        form: Form = subject.plain(1.0)
        places = smooth_places(k, (1.0,), subject.end / form.radius_scale)
    else:
        form = wavy_form(subject.table, subject.stretch, subject.wavelength, subject.mean_height)
        bend, gain, _, _, _ = form.numbers
        wave = ShortWave(k, bend, subject.chi, gain, float(subject.table["phase"]))
        form = Form(SHORT, subject.table, wave[:], subject.wavelength / TWO_PI, form.depth_scale, form.load_scale)
        end = subject.end / form.radius_scale
        few, folds = folds_of_wave(wave, 0.5 * (1.0 - k), end)
        few_too, load_folds = folds_of_wave(wave, 0.5 * (3.0 + k), end)
        if not (few and few_too):
            return None
        places = np.union1d(folds, load_folds)
    return draw_named(subject, form, places, "asymptotic")
