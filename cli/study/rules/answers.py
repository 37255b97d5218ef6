"""What a study asks beyond its scenes: what is sought of them, and how far its inputs may be off."""

import math
from dataclasses import dataclass

from gradhesion.cli.names.outputs import OF_LINEAR, SI


@dataclass(frozen=True, kw_only=True)
class Searched:
    """An input that is searched."""

    name: str
    low: float
    high: float
    log: bool
    """Whether it is searched in its logarithm."""


@dataclass(frozen=True, kw_only=True)
class Search:
    """What is sought."""

    goals: tuple[str, ...] = ()
    """One output, or two whose best compromises are sought; those in SI units end so."""
    signs: tuple[int, ...] = ()
    """1 where a goal is to be as large as possible, -1 where as small."""
    inputs: tuple[Searched, ...] = ()
    resolution: int = 200
    one_disc: bool = False
    limits: tuple[tuple[str, float, float], ...] = ()
    """Outputs with the least and the greatest value that they may have."""

    def __bool__(self) -> bool:
        """Report whether anything is sought."""
        return bool(self.goals)

    @property
    def is_front(self) -> bool:
        """Whether the best compromises of two goals are sought."""
        return len(self.goals) > 1

    @property
    def reported(self) -> tuple[str, ...]:
        """The outputs that are reported of an optimum: the goals, and what is limited."""
        return tuple(dict.fromkeys(name.removesuffix(SI) for name in (*self.goals, *(one for one, *_ in self.limits))))

    @property
    def solved(self) -> tuple[str, ...]:
        """The outputs that are solved for on the way; `delta_max` follows the loading path, where nothing else does."""
        return (*self.reported, *(("delta_max",) if self.one_disc else ()))

    @property
    def points(self) -> int:
        """Points of the sweep of one cell: at twice the resolution."""
        return int((2 * self.resolution - 1) ** len(self.inputs)) if self else 1

    @property
    def slope(self) -> str:
        """The sensitivity that belongs to the goal; empty if it has none, or there are two."""
        plain = self.goals[0].removesuffix(SI) if len(self.goals) == 1 else ""
        return f"{plain}_sensitivity" if plain in OF_LINEAR else ""


@dataclass(frozen=True, kw_only=True)
class Deviation:
    """The distribution of one input, in SI units: normal about the value of each scene, or uniform."""

    deviation: float = 1.0
    relative: bool = False
    """Whether it is a share of the value."""
    low: float = -math.inf
    high: float = math.inf
    """The bounds of the input, or the ends of a uniform distribution."""
    uniform: bool = False


@dataclass(frozen=True, kw_only=True)
class Uncertainty:
    """What is uncertain, and how its effect is found."""

    deviations: tuple[tuple[str, Deviation], ...] = ()
    """The uncertain inputs, in the order of a dataset's dimensions."""
    samples: int = 0
    """Of quasi-random inputs, the same for all scenes; 0: sensitivities alone."""
    seed: int = 0

    def __bool__(self) -> bool:
        """Report whether anything is uncertain."""
        return bool(self.deviations)
