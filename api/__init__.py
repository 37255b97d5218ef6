"""Adhesive contact of wavy punches on power-law graded materials, for scripts and notebooks: `import gradhesion as gr`.

Names are imported when they are first asked for, so that the import itself costs next to nothing. Datasets of xarray
have the accessor `dataset.gr` from the first call of a function of this package on, or from its import on where xarray
is imported before it.

>>> import gradhesion as gr
>>> smooth = gr.solve(k=[0.0, 0.5], nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.1, A=0.0, a_max_over_R=1.0)
>>> smooth["pull_off_force"].sel(k=0.5).round(12).item()  # (3 + k)/3
1.166666666667
"""

import importlib
import sys
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from gradhesion.cli.errors import DatasetError, GradhesionError, MissingExtraError, OutputError, StudyError
    from gradhesion.cli.names.curves import CURVES
    from gradhesion.cli.names.outputs import OUTPUTS
    from gradhesion.cli.names.scenes import PARAMETERS
    from gradhesion.cli.study.study import Study
    from gradhesion.core.answers.flags import FLAGS
    from gradhesion.core.problem.control import CONTROLS
    from gradhesion.core.problem.names import SOLVERS
    from gradhesion.core.problem.profile import Harmonic, Profile
    from gradhesion.datasets import open_dataset as open  # noqa: A004 (gr.open)
    from gradhesion.datasets import verify
    from gradhesion.pictures import explore, plot
    from gradhesion.scenes import curves, solve
    from gradhesion.studies import load, run

    __version__: str

__all__ = [
    "CONTROLS", "CURVES", "FLAGS", "OUTPUTS", "PARAMETERS", "SOLVERS", "DatasetError", "GradhesionError",
    "Harmonic", "MissingExtraError", "OutputError", "Profile", "Study", "StudyError", "__version__",
    "curves", "explore", "load", "open", "plot", "run", "solve", "verify",
]  # fmt: skip

_HOMES: Final = {
    "cli.errors": "DatasetError GradhesionError MissingExtraError OutputError StudyError",
    "cli.names.curves": "CURVES",
    "cli.names.outputs": "OUTPUTS",
    "cli.names.scenes": "PARAMETERS",
    "cli.study.study": "Study",
    "core.answers.flags": "FLAGS",
    "core.problem.control": "CONTROLS",
    "core.problem.names": "SOLVERS",
    "core.problem.profile": "Harmonic Profile",
    "datasets": "open verify",
    "pictures": "explore plot",
    "scenes": "curves solve",
    "studies": "load run",
}
"""What is public of each module."""

_HOME_OF: Final = {name: home for home, names in _HOMES.items() for name in names.split()}

_OWN_NAMES: Final = {"open": "open_dataset"}
"""What a name is called in its module, where that is another."""


def __getattr__(name: str) -> Any:
    """Import a public name when it is first asked for."""
    if name == "__version__":
        from importlib.metadata import version

        value: Any = version("gradhesion")
    else:
        if name not in _HOME_OF:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        from gradhesion.cli.installation import checked, refuse_without_threads

        refuse_without_threads()
        with checked():
            value = getattr(importlib.import_module(f"{__name__}.{_HOME_OF[name]}"), _OWN_NAMES.get(name, name))
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """List the public names, imported or not, and no others."""
    return sorted(__all__)


if hasattr(sys.modules.get("xarray"), "register_dataset_accessor"):
    importlib.import_module(f"{__name__}.accessor")
