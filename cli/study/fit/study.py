"""A study of kind "fit": parameters from measured loops. It has no scenes.

Its form and its rules stand apart (form.py, rules.py): a study of scenes loads neither.
"""

import hashlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from gradhesion.cli.study.fit.loop_file import LoopFile, notes_of
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core.loops.paths.offsets import NAMES as OFFSETS
from gradhesion.core.loops.paths.offsets import Offsets
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.toughness import Rate, Toughness


@dataclass(frozen=True, kw_only=True, eq=False)
class FitStudy:
    """A valid study of a fit."""

    name: str
    title: str
    text: str
    """The study as TOML: reading it again gives the same study."""
    file: str
    """The file of the loop, or the pattern of several, as the study names them."""
    loops: tuple[LoopFile, ...]
    """The loops, one fit each, sorted by the names of their files."""
    fixed: Mapping[str, float]
    """What is given as a number, in SI units."""
    free: Mapping[str, tuple[float, float]]
    """What is searched, with the ends of its range."""
    offsets: Offsets
    average: bool
    """Whether many points are averaged."""
    given_noise: tuple[float, float] | None
    """Standard deviations of depth and load, in SI units, where the study has them."""
    intervals: str
    starts: int
    profile: Profile = field(default_factory=Profile)
    loading: Loading = field(default_factory=Loading)
    toughness: Toughness | None = None
    rate: Rate | None = None
    """The law of a moving edge; its power is searched where `free` has it."""
    adhesion_range: float | None = None
    """The range of the attraction in m, for the Tabor number, where the study has it."""
    folder: Path = Path()
    """Where the files are."""
    kind: str = "fit"

    @property
    def loop(self) -> LoopFile:
        """The first loop, which is the only one unless the study names several files."""
        return self.loops[0]

    @property
    def is_of_one(self) -> bool:
        """Whether there is one loop, named without a pattern."""
        return len(self.loops) == 1 and self.file == self.loop.file

    @property
    def noise_is_given(self) -> bool:
        """Whether the study has the noise."""
        return self.given_noise is not None

    @property
    def noise(self) -> tuple[float, float]:
        """The noise of the first loop."""
        return self.noise_of(self.loop)

    def noise_of(self, loop: LoopFile) -> tuple[float, float]:
        """Give the standard deviations of depth and load of one of its loops, in SI units."""
        return self.given_noise or loop.noise

    @property
    def in_words(self) -> str:
        """What is fitted, in numbers of points, cycles and loops."""
        points, cycles = (sum(getattr(loop, name) for loop in self.loops) for name in ("points", "cycles"))
        counts = f"{counted(points, 'point')} in {counted(cycles, 'cycle')}"
        return counts if self.is_of_one else f"{counts} of {counted(len(self.loops), 'loop')}"

    @property
    def parameters(self) -> tuple[str, ...]:
        """What is fitted, in the order of the dataset."""
        return (*self.free, *self.offsets.names)

    @property
    def sha256(self) -> str:
        """The fingerprint of its text."""
        return hashlib.sha256(self.text.encode()).hexdigest()

    @property
    def notes(self) -> tuple[str, ...]:
        """What there is to say of the data before they are fitted."""
        return tuple(sentence for loop in self.loops for sentence in (*notes_of(loop), *self._of_noise(loop)))

    def _of_noise(self, loop: LoopFile) -> Iterator[str]:
        """Say that noise was estimated."""
        if not self.noise_is_given and not loop.problem:
            depth, load = loop.noise
            yield (
                f"{loop.file}: noise estimated from differences of neighbours: {depth * 1e9:.3g} nm, "
                f"{load * 1e9:.3g} nN; give it under [fit] where it is known"
            )


def unit_of_parameter(name: str) -> str:
    """
    Give the unit in SI of what is fitted.

    >>> [unit_of_parameter(name) for name in ("E_star", "A", "exponent", "load_offset", "load_slope")]
    ['Pa', '1', '1', 'N', 'N/m']
    """
    own = dict(zip(OFFSETS, ("m", "N", "N/m"), strict=True), exponent="1")
    return own.get(name) or INPUTS[name].unit
