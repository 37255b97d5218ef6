"""The scenes of a dataset: its parameters and dimensions, the flags of its status, and where its values come from."""

from typing import Final

from gradhesion.core.problem import names
from gradhesion.core.problem.inputs import INPUTS

PARAMETERS: Final = {name: INPUTS[name].about for name in names.PARAMETERS}
"""Every parameter of a scene, in the order of a dataset's dimensions, with its `long_name`."""
SCENE: Final = "scene"
"""The one dimension of a dataset with `layout = "points"`."""
SOLVER: Final = "solver"
"""The first dimension of a dataset with several solvers."""
REALISATION: Final = "realisation"
"""The last dimension of the scenes of random roughness."""
SOLVERS: Final = "how the scenes are solved"
"""The `long_name` of `solver`."""
IDLE: Final = "without effect"
"""What the comment of a coordinate begins with that is there for completeness."""
STATUS: Final = "flags of a scene (0: nothing to report)"
"""The `long_name` of `status`."""
STEEP: Final = "steep_contact"
"""The coordinate that marks the scenes whose contact reaches a slope of the punch that is not small, if any does."""
STEEP_CONTACT: Final = "whether the contact reaches a slope of the punch above 1"
"""Its `long_name`."""
REFERENCES: Final = (
    "Jin, Guo & Wan (2013), Mechanics of axisymmetric adhesive contact of rough surfaces involving power-law graded "
    "materials; Johnson, Kendall & Roberts (1971), Surface energy and the contact of elastic solids"
)
"""The theory behind the values."""
