"""The control of a punch: its displacement, the load on it, or a machine of finite stiffness."""

from dataclasses import dataclass
from typing import Final

from gradhesion.core.problem.inputs import check_settings, setting

CONTROLS: Final = ("displacement", "load", "machine")
"""What is prescribed: the depth, the load, or the far end of a spring (its stiffness is a parameter of the scene)."""


@dataclass(frozen=True, kw_only=True)
class Loading:
    """The control of the punch: the quantity that is prescribed.

    Parameters
    ----------
    control
        One of `CONTROLS`. With "machine" the parameters of `solve` have `machine_stiffness`, S/(E* R) > 0.

    Raises
    ------
    ValueError
        For an unknown control.

    Examples
    --------
    >>> Loading().control
    'displacement'
    """

    control: str = setting(
        "prescribed quantity: the depth, the load, or the displacement of the far end of a spring",
        '"load"',
        default="displacement",
        choices=CONTROLS,
    )

    def __post_init__(self) -> None:
        check_settings(self)


BY_DISPLACEMENT: Final = Loading()
"""The default control."""
