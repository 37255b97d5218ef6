"""What a scene has to report: one small set of bit flags, 0 where there is nothing to say."""

from typing import Final

LOADING_NOT_ONE_DISC: Final = 1
"""Loading gains energy: on its way the edge is pressed shut, where the contact is no longer one disc."""
CLOSE_TO_A_JUMP: Final = 16
"""An error of 1e-12 in an input could change the number of jumps, or move the pull-off to another trough."""
NO_VALUE: Final = 64
"""A parameter is not a number or outside its range, or the scene cannot be resolved: the values are NaN."""

FLAGS: Final = {
    "loading_contact_not_one_disc": LOADING_NOT_ONE_DISC,
    "close_to_a_jump": CLOSE_TO_A_JUMP,
    "no_value": NO_VALUE,
}
"""Name of every flag in use, with its bit."""

FAILED: Final = NO_VALUE
"""The bits that mean that a scene has failed (the others only inform)."""
