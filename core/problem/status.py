"""The status of a scene: a set of bit flags, 0 if there is nothing to report."""

from dataclasses import dataclass
from typing import Final

from gradhesion.core.problem.outputs import CURVES, OUTPUTS

LOADING_NOT_ONE_DISC: Final = 1
"""On loading the surfaces would overlap outside the contact, so that it is not one disc; or a punch of several waves
touches elsewhere before its centre does. Reported if the loading path is followed, that is, if an output other than
those of the pull-off is requested."""
UNLOADING_NOT_ONE_DISC: Final = 2
"""The same on unloading. It never occurs, for any profile and control (docs/theory.md, sections 12 and 15)."""
PULL_OFF_AT_RIM: Final = 4
"""The pull-off force occurs at the rim (reported if it is requested)."""
JUMP_IN_TO_RIM: Final = 8
"""Full contact at the first touch: the jump at the depth 0 meets no stable contact within the rim. Reported if the
loading path is followed."""
CLOSE_TO_A_JUMP: Final = 16
"""An error of 1e-10 in an input could change the number of jumps, or move the pull-off to another trough."""
TOLERANCE_NOT_MET: Final = 32
"""The value is not as accurate as promised."""
NO_VALUE: Final = 64
"""A parameter is not a number or outside its range, or the scene cannot be resolved: the values are NaN."""
NO_CONTACT: Final = 1024
"""The depth at which the cycle turns is below first contact: force, energies and jumps are 0, radii NaN. In studies
that turn at a depth only, whose `status` is int16."""
TOO_MANY_WAVES: Final = 8192
"""The contact contains more waves than can be followed one by one: the values are NaN. In studies of patterns of
toughness or of a speed only, whose `status` is int16."""
POOR_FIT: Final = 2048
"""Fits: the residual of a loop exceeds its noise; the values are unreliable."""
ANOTHER_MINIMUM: Final = 4096
"""Fits: other values fit the loop as well, within its noise."""


@dataclass(frozen=True)
class Flag:
    """A flag of `status`."""

    bit: int
    name: str
    about: str


OF_SCENES: Final = (
    Flag(LOADING_NOT_ONE_DISC, "loading_contact_not_one_disc", "contact on loading is not one disc"),
    Flag(UNLOADING_NOT_ONE_DISC, "unloading_contact_not_one_disc", "contact on unloading is not one disc"),
    Flag(PULL_OFF_AT_RIM, "pull_off_at_rim", "the pull-off is at the rim"),
    Flag(JUMP_IN_TO_RIM, "jump_in_to_rim", "the jump-in reaches the rim"),
    Flag(
        CLOSE_TO_A_JUMP,
        "close_to_a_jump",
        "an input error of 1e-10 could change a number of jumps or the place of the pull-off",
    ),
    Flag(TOLERANCE_NOT_MET, "tolerance_not_met", "the requested accuracy is not reached"),
    Flag(NO_VALUE, "no_value", "a parameter is outside its range, or the scene cannot be resolved (a million waves)"),
    Flag(NO_CONTACT, "no_contact", "the cycle turns before first contact"),
    Flag(TOO_MANY_WAVES, "too_many_waves", "the contact contains more waves than can be followed"),
)
"""The flags of scenes; not every solver sets every one."""
OF_LOOPS: Final = (
    Flag(POOR_FIT, "poor_fit", "the residual exceeds the noise"),
    Flag(ANOTHER_MINIMUM, "another_minimum", "other values fit the loop as well within its noise"),
)
"""The flags that only fits have."""
FLAGS: Final = {flag.name: flag.bit for flag in OF_SCENES}
"""Name of every flag of a scene, with its bit."""
OF_EVERY_MAP: Final = {name: bit for name, bit in FLAGS.items() if bit < 2**7}
"""The flags that fit into a status of 8 bits: those of all studies except the ones that turn at a depth."""
OF_FITS: Final = {flag.name: flag.bit for flag in OF_LOOPS}
"""Name of every flag that only fits have, with its bit."""

DOUBTFUL: Final = LOADING_NOT_ONE_DISC | UNLOADING_NOT_ONE_DISC | TOLERANCE_NOT_MET
"""The bits of a scene whose values exist but may be wrong."""
FAILED: Final = TOLERANCE_NOT_MET | NO_VALUE
"""The bits that mean that a scene has failed (the others only inform)."""


def doubts_about(result: str, *, turned: bool = False) -> int:
    """Return the bits of `DOUBTFUL` that cast doubt on a result or a curve.

    That loading is not one disc counts where a result depends on how full contact is reached (docs/theory.md, section
    12), and for every value where cycles turn at a depth or a load (`turned`): loading determines the turning radius.
    """
    name = result.split("_sensitivity", maxsplit=1)[0]  # which is as reliable as its value
    of_loading = any(name in known and known[name].depends_on == "loading" for known in (OUTPUTS, CURVES))
    return DOUBTFUL if turned or of_loading else DOUBTFUL & ~LOADING_NOT_ONE_DISC
