"""A study of kind "fit": parameters from a measured loop. It has no scenes.

Its form and its rules stand apart (fit_form.py, fit_rules.py): a study of scenes loads neither.
"""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from gradhesion.cli.keys import INPUTS
from gradhesion.cli.study.loop_file import LoopFile, dropped_sentence
from gradhesion.core.answers.loop_points import OFFSETS
from gradhesion.core.problem.profile import Profile


@dataclass(frozen=True, kw_only=True, eq=False)
class FitStudy:
    """A valid study of a fit."""

    name: str
    title: str
    text: str
    """The study as TOML: reading it again gives the same study."""
    file: str
    """The file of the loop, as the study names it."""
    loop: LoopFile
    fixed: Mapping[str, float]
    """What is given as a number, in SI units."""
    free: Mapping[str, tuple[float, float]]
    """What is searched, with the ends of its range."""
    offsets: bool
    noise: tuple[float, float]
    """Standard deviations of depth and load, in SI units."""
    noise_is_given: bool
    intervals: str
    starts: int
    profile: Profile = field(default_factory=Profile)
    folder: Path = Path()
    """Where the file is."""
    kind: str = "fit"

    @property
    def parameters(self) -> tuple[str, ...]:
        """What is fitted, in the order of the dataset."""
        return (*self.free, *(OFFSETS if self.offsets else ()))

    @property
    def sha256(self) -> str:
        """The fingerprint of its text."""
        return hashlib.sha256(self.text.encode()).hexdigest()

    @property
    def notes(self) -> tuple[str, ...]:
        """What there is to say of the data before they are fitted."""
        sentences = [dropped_sentence(self.loop, self.file)]
        if not self.noise_is_given:
            depth, load = self.noise
            sentences.append(
                f"{self.file}: noise estimated from differences of neighbours: {depth * 1e9:.3g} nm, "
                f"{load * 1e9:.3g} nN; give it under [fit] where it is known"
            )
        return tuple(sentence for sentence in sentences if sentence)


def unit_of_parameter(name: str) -> str:
    """
    Give the unit in SI of what is fitted.

    >>> [unit_of_parameter(name) for name in ("E_star", "A", "load_offset", "spring_constant")]
    ['Pa', '1', 'N', 'N/m']
    """
    return {OFFSETS[0]: "m", OFFSETS[1]: "N"}.get(name) or INPUTS[name].unit
