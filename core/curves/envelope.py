"""The envelopes of short waves, (5.21)-(5.27): loading above, unloading below."""

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.curves.equilibrium import draw_through
from gradhesion.core.curves.smooth import smooth_places
from gradhesion.core.curves.subject import Subject


def draw_envelope(subject: Subject) -> dict[str, NDArray[np.float64]]:
    """Return the two envelopes of the asymptotic curve at common radii.

    Parameters
    ----------
    subject
        Any scene.

    Returns
    -------
    The variables `envelope_contact_radius`, `loading_envelope_...` and `unloading_envelope_...` (draw.CURVES). Depths
    hold the mean height lambda A, without which the waves would not lie between.
    """
    k = subject.k
    forms = [subject.plain(pull, subject.mean_height) for pull in (1.0 - subject.chi, 1.0 + subject.chi)]
    end = subject.end / forms[0].radius_scale
    turns = smooth_places(k, (1.0 - subject.chi, 1.0 + subject.chi), end)
    places = np.unique(np.concatenate([draw_through(form, turns, end)[0][0] for form in forms]))
    variables = {"envelope_contact_radius": places * forms[0].radius_scale}
    variables["envelope_contact_radius"][-1] = subject.end
    for name, form in zip(("loading", "unloading"), forms, strict=True):
        _, depth, load = form.scaled(form.states(places))
        variables |= {f"{name}_envelope_indentation": depth, f"{name}_envelope_load": load}
    return variables
