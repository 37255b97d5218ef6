"""The envelopes of short waves, (5.21)-(5.27) and those of any profile (closed/general_envelope.py)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gradhesion.core.closed.envelope import chis, scales_of
from gradhesion.core.curves.equilibrium import draw_through
from gradhesion.core.curves.forms import General, PowerLaw
from gradhesion.core.curves.smooth import Turns, turns_of
from gradhesion.core.curves.subject import Form, Subject
from gradhesion.core.problem.profile import Profile


class Envelopes(NamedTuple):
    """The two envelopes of a scene, each a smooth punch of a pull of its own."""

    up: Form  # of loading, with the mean height of the waves
    down: Form  # of unloading
    pulls: tuple[float, float]  # 1 - chi_+ and 1 + chi_-
    turns: Turns  # where they turn


def envelopes_of(subject: Subject, profile: Profile) -> Envelopes:
    """Return the envelopes of a scene under displacement control, and its punch."""
    k, m = subject.k, profile.exponent
    if not isinstance(subject.exact.numbers, General):
        pulls = 1.0 - subject.chi, 1.0 + subject.chi
        up, down = (subject.plain(pull, subject.mean_height) for pull in pulls)
        return Envelopes(up, down, pulls, turns_of(k))
    c, amplitude = 0.5 * (1.0 - k), subject.mean_height / subject.wavelength
    one, stretch = np.array([k]), np.array([subject.stretch])
    (rise,), (fall,) = chis(one, stretch, np.array([subject.wavelength]), np.array([amplitude]), profile)
    length, unit, force = (float(scale[0]) for scale in scales_of(one, stretch, m))
    pulls = float(1.0 - rise), float(1.0 + fall)
    height = subject.mean_height * sum(harmonic.cos for harmonic in profile.harmonics) / unit
    up, down = (Form(subject.table, PowerLaw(k, m, pull, height), length, unit, force) for pull in pulls)
    return Envelopes(up, down, pulls, Turns(c / m, 1.0, 0.5 * (3.0 + k) / m, 1.0 / (m - c)))


def draw_envelope(subject: Subject, profile: Profile) -> dict[str, NDArray[np.float64]]:
    """Return the two envelopes of the asymptotic curve at common radii.

    Parameters
    ----------
    subject, profile
        Any scene under displacement control, and its punch.

    Returns
    -------
    The variables `envelope_contact_radius`, `loading_envelope_...` and `unloading_envelope_...` (draw.CURVES). Depths
    include the mean height of the waves, lambda A of one cosine; without it the exact curve would not lie between.
    """
    up, down, pulls, turns = envelopes_of(subject, profile)
    end = subject.end / up.radius_scale
    knots = turns.places(pulls, end)
    places = np.unique(np.concatenate([draw_through(form, knots, end)[0][0] for form in (up, down)]))
    variables = {"envelope_contact_radius": places * up.radius_scale}
    variables["envelope_contact_radius"][-1] = subject.end
    for name, form in (("loading", up), ("unloading", down)):
        _, depth, load = form.scaled(form.states(places))
        variables |= {f"{name}_envelope_indentation": depth, f"{name}_envelope_load": load}
    return variables
