"""The states whose pressure and surface a curve study draws: what goes with them."""

from collections.abc import Iterator, Mapping

import numpy as np

from gradhesion.cli.keys import Path
from gradhesion.cli.names.curves import CURVES, STATE_CURVES
from gradhesion.cli.study.form.axes import Values
from gradhesion.cli.study.form.mistakes import Checked, Mistake

_RADII: Path = ("states", "contact_radius_over_R")


def mistakes_of_states(checked: Checked, sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check that the radii of states are drawn, differ, and lie within every punch."""
    radii = checked.form.states.radii
    if not radii or _RADII in checked.wrong or ("states",) in checked.wrong:
        return
    own = {*STATE_CURVES, *(name for curve in STATE_CURVES for name in CURVES[curve])}
    if ("outputs",) not in checked.wrong and not own & {*checked.form.outputs}:
        sentence = 'no curve of states is requested; add "pressure" or "surface" to the outputs of a curve study'
        yield Mistake(_RADII, list(radii), f"{sentence}, or remove [states]")
    rim = float(np.min(sound["a_max_over_R"])) if "a_max_over_R" in sound else np.inf
    for i, radius in enumerate(radii):
        if radius in radii[:i]:
            yield Mistake((*_RADII, i), radius, "this radius is given twice; remove one of the two")
        elif radius > rim:
            sentence = f"a contact cannot be wider than its punch, a_max_over_R = {rim:g}; use a radius in (0, {rim:g}]"
            yield Mistake((*_RADII, i), radius, sentence)
