"""A study of kind "fit": parameters from measured loops. It has no scenes."""

import hashlib
from dataclasses import dataclass, field
from pathlib import Path

from gradhesion.cli.study.fit.columns import LoopFileError
from gradhesion.cli.study.fit.loop_file import LoopFile, fingerprint, read_loops
from gradhesion.cli.study.fit.rules import NUMBER_ALONE, control_of, given_in
from gradhesion.cli.study.rules.asked import Asked
from gradhesion.cli.study.rules.form import Form
from gradhesion.cli.study.rules.inputs import shape_of
from gradhesion.cli.study.rules.keys import Range
from gradhesion.cli.study.rules.mistakes import Mistake
from gradhesion.cli.study.text.source import Source
from gradhesion.cli.study.text.written import with_fingerprints
from gradhesion.cli.tables.columns import changed
from gradhesion.cli.terminal.amounts import counted
from gradhesion.core.loops.paths.offsets import NAMES as OFFSETS
from gradhesion.core.loops.paths.offsets import Offsets
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.toughness import Rate, Toughness


@dataclass(frozen=True, kw_only=True, eq=False)
class FitStudy:
    """A valid study of a fit; the power of its law of speed is searched where `free` has it."""

    name: str
    title: str
    text: str
    """The study as TOML: reading it again gives the same study."""
    file: str
    """The file of the loop, or the pattern of several, as the study names them."""
    loops: tuple[LoopFile, ...]
    """The loops, one fit each, sorted by the names of their files."""
    fixed: dict[str, float]
    """What is given as a number, in SI units."""
    free: dict[str, tuple[float, float]]
    """What is searched, with the ends of its range."""
    offsets: Offsets
    average: bool
    """Whether many points are averaged."""
    given_noise: tuple[float, float] | None
    """Standard deviations of depth and load, in SI units, where the study has them."""
    intervals: str
    starts: int
    adhesion_range: float | None = None
    """The range of the attraction in m, for the Tabor number, where the study has it."""
    profile: Profile = field(default_factory=Profile)
    loading: Loading = field(default_factory=Loading)
    toughness: Toughness | None = None
    rate: Rate | None = None
    folder: Path = Path()
    """Where the files are."""
    kind: str = "fit"

    @property
    def sha256(self) -> str:
        """The fingerprint of its text."""
        return hashlib.sha256(self.text.encode()).hexdigest()

    @property
    def loop(self) -> LoopFile:
        """The first loop, which is the only one unless the study names several files."""
        return self.loops[0]

    @property
    def is_of_one(self) -> bool:
        """Whether there is one loop, named without a pattern."""
        return len(self.loops) == 1 and self.file == self.loop.file

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
    def notes(self) -> tuple[str, ...]:
        """What there is to say of the data before they are fitted."""
        sentences = []
        for loop in self.loops:
            sentences += loop.notes
            if self.given_noise is None and not loop.problem:
                depth, load = (1e9 * one for one in loop.noise)
                words = f"{loop.file}: noise estimated from differences of neighbours: {depth:.3g} nm, {load:.3g} nN"
                sentences.append(f"{words}; give it under [fit] where it is known")
        return tuple(sentences)


def loops_of(folder: Path, asked: Asked) -> tuple[tuple[LoopFile, ...], list[Mistake]]:
    """Read the loops that a fit names in its table [data], which is right; and what is wrong with them."""
    table, form = asked.form.data, asked.form
    assert table is not None  # noqa: S101 (it is right)
    fitted = [name for name, entry in given_in(form).items() if isinstance(entry, Range)]
    fitted += Offsets(**dict(form.fit.offsets)).names
    through_machine = control_of(form) == "machine"
    try:
        loops = read_loops(folder, table, fitted, average=form.fit.average, through_machine=through_machine)
    except LoopFileError as error:
        return (), [(("data", error.key), str(error))]
    sha256 = fingerprint(loops)
    if table.sha256 in ("", sha256):
        return loops, []
    several = table.file not in {loop.file.partition("#")[0] for loop in loops}
    words = changed(sha256, table.sha256, "remove sha256", several=several)
    return loops, [(("data", "file"), words)]


def fit_of(source: Source, form: Form, loops: tuple[LoopFile, ...]) -> FitStudy:
    """Make the study of a fit from a form that is right, and its loops."""
    noise, given = form.fit.noise, given_in(form)
    free = {name: (entry.start, entry.stop) for name, entry in given.items() if isinstance(entry, Range)}
    fixed = {name: float(entry) for name, entry in given.items() if isinstance(entry, int | float)}
    exponent = fixed.pop("exponent", 0.0) or sum(free.get("exponent", ())) / 2.0
    return FitStudy(
        name=source.name,
        title=form.title or source.name,
        text=with_fingerprints(source.data, source.text, {("data",): fingerprint(loops)}),
        file=source.data["data"]["file"],
        loops=loops,
        fixed={name: value for name, value in fixed.items() if name not in NUMBER_ALONE},
        free=free,
        offsets=Offsets(**dict(form.fit.offsets)),
        average=form.fit.average,
        given_noise=None if noise is None else (noise.indentation or noise.displacement or 0.0, noise.load),
        intervals=form.fit.intervals,
        starts=form.fit.starts,
        profile=shape_of(form.profile),
        loading=Loading(control=control_of(form)),
        toughness=form.toughness.made() if form.toughness else None,
        rate=form.rate.made(exponent=exponent) if form.rate else None,
        adhesion_range=fixed.get("adhesion_range"),
        folder=source.folder,
    )


def unit_of_parameter(name: str) -> str:
    """Give the unit in SI of what is fitted.

    >>> [unit_of_parameter(name) for name in ("E_star", "A", "exponent", "load_offset", "load_slope")]
    ['Pa', '1', '1', 'N', 'N/m']
    """
    own = dict(zip(OFFSETS, ("m", "N", "N/m"), strict=True), exponent="1")
    return own.get(name) or INPUTS[name].unit
