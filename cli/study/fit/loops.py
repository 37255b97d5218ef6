"""Measured loops: their columns in SI units from tables and instruments' files, their branches, noise and means.

Instruments' files are read by afmformats, with the conventions of force microscopy: a height is the position of the
base of the cantilever, and falls as it approaches; a force is the deflection times the spring constant, and presses
where it is positive. The machine has moved by minus the height, and the depth is that less the deflection.
"""

import hashlib
import logging
import warnings
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from glob import glob
from pathlib import Path, PurePath
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.disk import read_at_most
from gradhesion.cli.study.rules.fit_form import ColumnTable, DataTable
from gradhesion.cli.study.text.quantities import factor_of_column
from gradhesion.cli.tables.columns import Columns, ColumnsError
from gradhesion.cli.tables.reading import MOST_BYTES, read_columns
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.terminal.wording import did_you_mean, shown
from gradhesion.core.loops.measured import points as loop_points
from gradhesion.core.loops.measured.features import fault_of
from gradhesion.core.loops.measured.points import MOST, averaged, noise_of

MOST_FILES: Final = 10_000
"""Files of one study: each is a fit."""
INSTRUMENTS: Final = (".ibw", ".jpk-force", ".jpk-force-map", ".jpk-qi-data", ".jpk-qi-series", ".zip")
"""How the names of files end that are of an instrument, and no tables."""
EITHER: Final = (".h5", ".tab")
"""How those end that are of afmformats where the study names no columns, and tables where it does."""
PAUSES: Final = ("pause", "hold", "dwell", "creep", "modulate")
"""What instruments call a stretch between branches, in which the punch waits: such rows are left out."""
PAUSE: Final = 2.0
"""The number of a pause between branches."""
_WAYS: Final = "loading unloading approach retract approaching retracting extend withdraw forward backward false true"
BRANCHES: Final = {word: float(i % 2) for i, word in enumerate(_WAYS.split())}
"""What a column of branches says, with the number for it, which may stand there as well."""
_HEIGHTS: Final = ("height (measured)", "height (piezo)")
"""An instrument's columns of heights, the better first."""
_TIP: Final = "tip position"
"""That of the height of the tip: height plus deflection."""
_DEPTH: Final = "depth of the contact, or path of the machine"
"""The column that is computed of these."""
_NONE: Final = np.zeros(0)
_SIGNS: Final = {
    "depth": ("depth", "the load rises towards the shallowest points, but depth grows into the half-space"),
    "load": ("load", "the load falls towards the deepest points, but positive loads press"),
    "both": ("load", "the load falls towards the shallowest points: both its sign and that of the depth are wrong"),
}
"""The key that is wrong, and why, by the fault of the points."""


class LoopFileError(ValueError):
    """A file has no loop: `key` is the key of [data] that is wrong; the message says why, and what to do."""

    def __init__(self, key: str, sentence: str) -> None:
        self.key = key
        super().__init__(sentence)


@dataclass(frozen=True, kw_only=True, eq=False)
class LoopFile:
    """The points of a measured loop, or means of many."""

    depth: NDArray[np.float64] = field(default_factory=_NONE.copy)
    """In m: of the contact, or of the machine."""
    load: NDArray[np.float64] = field(default_factory=_NONE.copy)
    """In N; positive presses."""
    unloading: NDArray[np.bool_] = field(default_factory=lambda: _NONE.astype(bool))
    cycle: NDArray[np.int64] = field(default_factory=lambda: _NONE.astype(np.int64))
    """The number of the cycle of each point, from 1 unless the file has them."""
    counts: NDArray[np.float64] = field(default_factory=_NONE.copy)
    """How many points of the file each is the mean of."""
    file: str = ""
    """The name of the file, from the folder of the study; behind # which of its loops this is."""
    sha256: str = ""
    dropped: int = 0
    """Rows without a number that were left out."""
    paused: int = 0
    """Rows of pauses that were left out."""
    noise: tuple[float, float] = (0.0, 0.0)
    """Standard deviations of depth and load of a point of the file, estimated from the points."""
    problem: str = ""
    """Why it cannot be fitted, where it is one of several; it has no points then."""

    @property
    def cycles(self) -> int:
        """The number of its cycles."""
        return np.unique(self.cycle).size

    @property
    def points(self) -> int:
        """The number of points of the file."""
        return int(self.counts.sum())

    @property
    def notes(self) -> list[str]:
        """What was left out of it, and what was averaged."""
        if self.problem:
            return [f"{self.file}: {self.problem}"]
        left_out = ((self.dropped, "without a number left out"), (self.paused, "of pauses left out"))
        sentences = [f"{counted(count, 'row')} {what}" for count, what in left_out if count]
        if self.points > self.depth.size:
            sentences.append(f"{counted(self.points, 'point')} averaged along the path; {self.depth.size:,} kept")
        return [f"{self.file}: {sentence}" for sentence in sentences]


def fingerprint(loops: Iterable[LoopFile]) -> str:
    """Give the SHA-256 of the file, or of the names and fingerprints of several."""
    own = {loop.file.partition("#")[0]: loop.sha256 for loop in loops}
    if len(own) == 1:
        return next(iter(own.values()))
    return hashlib.sha256("".join(f"{name} {sha256}\n" for name, sha256 in own.items()).encode()).hexdigest()


def read_loops(
    folder: Path, table: DataTable, fitted: list[str], *, average: bool, through_machine: bool
) -> tuple[LoopFile, ...]:
    """Read all loops of a study, sorted by the names of their files; LoopFileError where none of them can be fitted.

    There must be points enough for what is `fitted`; one of several loops that cannot be is kept with its problem. Many
    points are averaged if `average`; depths are displacements of a machine if `through_machine`.
    """
    names = [table.file]
    if any(mark in table.file for mark in "*?[") and not (folder / table.file).exists():
        found = glob(table.file, root_dir=folder, recursive=True)  # noqa: PTH207 (patterns may be absolute)
        names = sorted(name for name in found if (folder / name).is_file())
    if not 0 < len(names) <= MOST_FILES:
        what = f"{len(names):,} files are more than {MOST_FILES:,}" if names else "no file matches this pattern"
        raise LoopFileError("file", f'{what}; write the path from the folder of the study, as "curves/*.csv"')
    loops: list[LoopFile] = []
    errors: list[LoopFileError] = []
    for name in names:
        try:
            if is_force_file(table.model_copy(update={"file": name})):
                known, curves = _of_instrument(folder / name, table, through_machine=through_machine)
            else:
                known, curves = table, {"": _of_table(folder / name, table)}
            files = ((f"{name}#{of}" if len(curves) > 1 else name, found) for of, found in curves.items())
            loops += [_loop(found, file, known, fitted, average=average) for file, found in files]
        except LoopFileError as error:
            errors.append(error)
            sha256 = ""
            with suppress(OSError):
                sha256 = hashlib.sha256(read_at_most(folder / name, MOST_BYTES)).hexdigest()
            loops.append(LoopFile(file=name, problem=str(error), sha256=sha256))
    if errors and all(loop.problem for loop in loops):
        several = f" (and so with each of the {counted(len(loops), 'loop')})"
        words = str(errors[0]) if len(loops) == 1 else f"{loops[0].file}: {errors[0]}{several}"
        raise LoopFileError(errors[0].key, words)
    return tuple(loops)


def is_force_file(table: DataTable) -> bool:
    """Tell whether a file is an instrument's, by its name and whether columns are named."""
    suffix = PurePath(table.file).suffix.lower()
    return suffix in INSTRUMENTS or (suffix in EITHER and not (table.depths or table.load))


def _of_instrument(path: Path, table: DataTable, *, through_machine: bool) -> tuple[DataTable, dict[str, Columns]]:
    """Read the force curves of a file, by their numbers, and name their columns where the study does not."""
    try:
        import afmformats  # noqa: PLC0415 (not there without the extra)
        from afmformats.errors import AFMFileFormatError, MissingMetaDataError  # noqa: PLC0415
    except ModuleNotFoundError:
        raise LoopFileError("file", "afmformats is missing; install it, `pip install gradhesion[afm]`") from None
    log = logging.getLogger("afmformats")  # which writes the traceback of what is raised
    silent, log.disabled = log.disabled, True
    try:
        sha256 = hashlib.sha256(path.read_bytes()).hexdigest()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            curves = afmformats.load_data(path, modality="force-distance")
            own = {str(one.enum): _of_curve(one, sha256, table, through_machine=through_machine) for one in curves}
    except LoopFileError:
        raise
    except (AFMFileFormatError, MissingMetaDataError, Exception) as error:  # noqa: BLE001 (the first two are none)
        reason = " ".join(str(error).split())[:200] or type(error).__name__
        remedy = "name one that is there, or export it again or as CSV"
        raise LoopFileError("file", f"the file cannot be read ({reason}); {remedy}") from None
    finally:
        log.disabled = silent
    if not own:
        raise LoopFileError("file", "the file has no force curves; name one with approach and retraction")
    branch = "segment" if all("segment" in found.values for found in own.values()) else None
    names: dict[str, Any] = {"load": table.load or ColumnTable(column="force"), "branch": branch, "cycle": None}
    names |= {} if table.depths else {"indentation": ColumnTable(column=_DEPTH)}
    return table.model_copy(update=names), own


def _of_curve(curve: Any, sha256: str, table: DataTable, *, through_machine: bool) -> Columns:
    """Give the columns of a force curve in SI units, that of the depths among them if the study names none."""
    named = [one.column for one in (table.indentation, table.displacement, table.load) if one]
    names = [name for name in (*_HEIGHTS, _TIP, "force", "segment", *named) if name in curve]
    values = {name: np.asarray(curve[name], dtype=np.float64) for name in names}
    if "segment" in values:
        values["segment"] = np.minimum(values["segment"], PAUSE)
    height = next((name for name in _HEIGHTS if name in values), _HEIGHTS[0])
    is_depth = through_machine or _TIP in values  # without the deflection
    place = _TIP if _TIP in values and not through_machine else height
    for name in ("force", place):
        if name not in values and not (table.load if name == "force" else table.depths):
            near = did_you_mean(name, curve.columns)
            raise LoopFileError("file", f"the file has no column {shown(name)}; {near}, or export it with that one")
    if not table.depths:
        spring = float(curve.metadata.get("spring constant", np.nan))
        if not is_depth and not spring > 0.0:
            remedy = 'name a column of depths, indentation = { column = "tip position", sign = -1 }, or calibrate it'
            raise LoopFileError("file", f"the file has no spring constant, and so no deflection; {remedy}")
        values[_DEPTH] = -values[place] - (0.0 if is_depth else values["force"] / spring)
    units = {name: "N" if name == "force" else "m" for name in values}
    return Columns(values=values, units=units, sha256=sha256, place=str, others=tuple(curve.columns))


def _of_table(path: Path, table: DataTable) -> Columns:
    """Read the columns of a loop from a table, those of unloading behind those of loading where they are apart."""
    depth, load = getattr(table, table.depths), table.load
    assert load is not None  # noqa: S101 (the rules of a fit ask for it)
    if depth.column == load.column:
        raise LoopFileError("load", f"the column {shown(load.column)} has the depths; name that of the loads")
    if bool(depth.back) != bool(load.back) or (depth.back and (table.branch or table.cycle)):
        sentence = "back names the columns of unloading, of depths and of loads, and then there is no branch or cycle"
        raise LoopFileError("load" if depth.back else table.depths, f"{sentence}; write all of them so")
    wanted = [name for name in (depth.column, load.column, depth.back, load.back, table.branch, table.cycle) if name]
    pauses = dict.fromkeys((*PAUSES, *(word.strip().lower() for word in table.leave_out)), PAUSE)
    words = {table.branch: BRANCHES | pauses} if table.branch else {}
    try:
        return read_columns(path, only=wanted, words=words, whole=[table.cycle] if table.cycle else [])
    except ColumnsError as error:
        raise LoopFileError("file", str(error)) from None


def _loop(found: Columns, file: str, table: DataTable, fitted: list[str], *, average: bool) -> LoopFile:
    """Take the columns of a loop, leave rows out, tell the branches, average, and refuse what is no loop."""
    depth, load, branch, numbers = _rows(found, table)
    paused = branch == PAUSE
    sound = np.isfinite([depth, load, branch, numbers]).all(axis=0)
    use = sound & ~paused
    if not use.any():
        why = "every row belongs to a pause" if sound.any() else "no row has numbers in all of its columns"
        raise LoopFileError("file", f"{why}; name a file with some")
    depth, load, cycle = depth[use], load[use], numbers[use].astype(np.int64)
    rank = np.unique(cycle, return_inverse=True)[1].astype(np.int32) if table.cycle else None
    if table.branch or getattr(table, table.depths).back:
        unloading = branch[use] == 1.0
        rank = np.ones(depth.size, np.int32) if rank is None else rank
    elif loop_points.has_order(depth, rank):
        unloading, rank = loop_points.ways(depth, rank)
    else:
        turns = int(loop_points.ways(depth)[1].max())
        what = f"the order of the points does not tell the branches ({turns:,} turns of {depth.size:,} points)"
        remedy = 'name a column that has them, branch = "branch", or sort the rows as they were measured'
        raise LoopFileError("file", f"{what}; {remedy}")
    cycle = cycle if table.cycle else rank.astype(np.int64)
    if table.which is not None:
        own = unloading == (table.which == "unloading")
        if not own.any():
            raise LoopFileError("which", f"the data have no {table.which}; write the other branch, or remove which")
        depth, load, unloading, rank, cycle = (row[own] for row in (depth, load, unloading, rank, cycle))
    noise = noise_of(depth, load, unloading, rank)
    kept = averaged(depth, load, unloading, rank, noise, most=MOST if average else depth.size)
    if kept.depth.size < depth.size:
        number_of = dict(zip(rank.tolist(), cycle.tolist(), strict=True))
        cycle = np.array([number_of[one] for one in kept.cycle.tolist()], np.int64)
    loop = LoopFile(
        depth=kept.depth,
        load=kept.load,
        unloading=kept.unloading,
        cycle=cycle,
        counts=kept.counts,
        file=file,
        sha256=found.sha256,
        dropped=int(np.count_nonzero(~sound & ~paused)),
        paused=int(np.count_nonzero(paused)),
        noise=kept.noise,
    )
    _refuse(loop, table, fitted)
    return loop


def _rows(found: Columns, table: DataTable) -> NDArray[np.float64]:
    """Give rows of depth, load, branch (0, 1, or a pause) and cycle, NaN where a number is missing."""

    def column(key: str, name: str, own: ColumnTable | None = None) -> NDArray[np.float64]:
        if name not in found.values:
            there = (*found.values, *found.others)
            raise LoopFileError(key, f"the file has no column {shown(name)}; {did_you_mean(name, there)}")
        try:
            kind = "load" if key == "load" else "indentation"
            factor = own.sign * float(factor_of_column(found, name, kind, own.unit)) if own else 1.0
        except ColumnsError as error:
            raise LoopFileError(key, str(error)) from None
        return found.values[name] * factor

    measured = {key: getattr(table, key) for key in (table.depths, "load")}
    both = [np.array([column(key, one.column, one) for key, one in measured.items()])]
    ways = {key: column(key, name) for key in ("branch", "cycle") if (name := getattr(table, key))}
    if table.load and table.load.back:
        both.append(np.array([column(key, one.back, one) for key, one in measured.items()]))
        for back, points in enumerate(both):  # unloading behind loading, in the order of a cycle; the shorter is padded
            points = points[:, ~np.isnan(points).all(axis=0)]
            falls = points.size > 0 and points[0, -1] < points[0, 0]
            both[back] = points if falls == bool(back) else points[:, ::-1]
        ways = {"branch": np.repeat([0.0, 1.0], [points.shape[1] for points in both])}
    rows = np.concatenate(both, axis=1)
    return np.vstack([rows, *(ways.get(key, np.zeros(rows.shape[1])) for key in ("branch", "cycle"))])


def _refuse(loop: LoopFile, table: DataTable, fitted: list[str]) -> None:
    """Refuse points without contact, with a wrong sign, too few for what is fitted, or all the same."""
    fault = fault_of(loop.depth, loop.load, loop.noise[1] / np.sqrt(loop.counts), loop.unloading)
    if fault == "straight":
        raise LoopFileError("load", "the data show no contact, but a linear load; name another file or column")
    if fault:
        key, words = _SIGNS[fault]
        key = table.depths if key == "depth" else key
        own = getattr(table, key)
        remedy = f'write {key} = {{ column = "{own.column}", sign = -1 }} with its unit'
        raise LoopFileError(key, f"{words}; {'leave its sign out' if own.sign == -1 else remedy}")
    if loop.depth.size <= len(fitted):
        words = f"{loop.depth.size} points are too few for {len(fitted)} fitted values ({', '.join(fitted)})"
        raise LoopFileError("file", f"{words}; measure more points, or fix some")
    for row, values in (("depth", loop.depth), ("load", loop.load)):
        if np.ptp(values) == 0.0:
            raise LoopFileError("file", f"all values of the {row} are the same; name another column")
