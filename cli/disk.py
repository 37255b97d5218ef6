"""Files that appear whole or not at all, and failures to write in a sentence."""

import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from itertools import count
from pathlib import Path

from gradhesion.cli.errors import OutputError
from gradhesion.cli.terminal.amounts import bytes_in_words


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Turn a failure to write into a sentence about `path`."""
    try:
        yield
    except (OSError, RuntimeError) as error:  # netCDF4 raises RuntimeError where HDF5 cannot write
        raise OutputError(_reason(path, error)) from error


@contextmanager
def replacement(path: Path, *, overwrite: bool) -> Iterator[Path]:
    """
    Give a temporary file beside `path` that takes its place, complete and on disk, when the body ends.

    If the body fails, or is interrupted, the temporary file goes and what stood at `path` is as it was.

    Raises
    ------
    OutputError
        At once, if `path` exists and may not be replaced or its folder cannot be written; later, if it cannot be
        finished, or if a file has appeared there meanwhile: then the new one is kept beside it.
    """
    target = Path(os.path.realpath(path))
    refuse_existing(path, target, overwrite=overwrite)
    # Its name is known before it is made, so that no interrupt comes between the two and leaves it behind.
    temporary = target.with_name(f".{target.name[:100]}.{secrets.token_hex(8)}.part{target.suffix}")
    try:
        with writing(path):
            target.parent.mkdir(parents=True, exist_ok=True)
            temporary.touch(exist_ok=False)
        yield temporary
        with writing(path):
            to_disk(temporary)
            place = settled(temporary, target, overwrite=overwrite)
        with suppress(OSError):  # some file systems cannot sync a folder
            to_disk(target.parent)
        refuse_beside(path, place, target)
    finally:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)


def refuse_existing(path: Path, target: Path, *, overwrite: bool) -> None:
    """Refuse to replace what is not a file, or was not to be replaced."""
    with writing(path):
        exists, is_file = target.exists(), target.is_file()
    if exists and not is_file:
        raise OutputError(f"{path}: is not a file, so it cannot be replaced; name another output with -o")
    if exists and not overwrite:
        raise OutputError(f"{path}: exists already; add --overwrite to replace it, or name another output with -o")


def settled(temporary: Path, target: Path, *, overwrite: bool) -> Path:
    """
    Give a finished file its name, or one beside it if something stands there that may not be replaced.

    Nothing is replaced without `overwrite`, whenever it appears: the system itself refuses a name that is taken.

    Raises
    ------
    OSError
        It cannot be renamed.
    """
    try:
        if overwrite:
            rename(temporary, target)
        else:
            _rename_anew(temporary, target)
    except (FileExistsError, IsADirectoryError):
        for number in count(2):
            beside = target.with_name(f"{target.stem}-{number}{target.suffix}")
            with suppress(FileExistsError):
                _rename_anew(temporary, beside)
                return beside
    return target


def refuse_beside(path: Path, place: Path, target: Path) -> None:
    """
    Say where a finished file is that could not have its name.

    Raises
    ------
    OutputError
        It has another.
    """
    if place != target:
        name = place if path.is_symlink() else path.with_name(place.name)
        raise OutputError(
            f"{path}: appeared during the run and is untouched; the new file is complete and kept as {name}; move it "
            "where it belongs"
        )


def _rename_anew(source: Path, target: Path) -> None:
    """Rename a file to a name that nothing has; FileExistsError if something has it.

    A server of files that answers late may be asked twice, and refuses then what it has done itself.
    """
    try:
        target.hardlink_to(source)
    except FileExistsError:
        if not _is_same(source, target):
            raise
        source.unlink()
    except OSError:  # a file system without links: the name is taken by an empty file first
        os.close(os.open(target, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
        try:
            rename(source, target)
        except BaseException:
            target.unlink()
            raise
    else:
        source.unlink()


def rename(source: Path, target: Path) -> None:
    """
    Rename a file, in the place of what has that name.

    Raises
    ------
    OSError
        It cannot be; not where a server of files, asked twice, no longer finds what it has renamed.
    """
    before = source.stat()
    try:
        source.replace(target)
    except FileNotFoundError:
        with suppress(OSError):
            if os.path.samestat(before, target.stat()):
                return
        raise


def _is_same(one: Path, other: Path) -> bool:
    """Check whether two names are of one file."""
    try:
        return one.samefile(other)
    except OSError:
        return False


def refuse_unnamed(path: Path, target: Path) -> None:
    """
    Refuse a name for a dataset that the library of NetCDF cannot open.

    Raises
    ------
    OutputError
        It is not UTF-8; or it has a backslash, which the library takes for the mark of a folder.
    """
    name = os.fspath(target)
    if os.sep == "/" and "\\" in name:
        raise OutputError(
            f"{path}: its name, or that of a folder above it, has a backslash, which NetCDF misreads; name another"
        )
    try:
        name.encode()
    except UnicodeEncodeError:
        raise OutputError(
            f"{path}: its name, or that of a folder above it, is not UTF-8, as NetCDF needs it; name another with -o"
        ) from None


def write_whole(path: Path, *pieces: bytes | memoryview, sync: bool = True) -> None:
    """Write a file under another name, wait until it is on disk, and give it its name."""
    temporary = path.with_name(f"{path.name}.{secrets.token_hex(8)}.tmp")
    try:
        with temporary.open("xb", buffering=0) as file:
            for piece in pieces:
                rest = memoryview(piece)
                while rest:
                    rest = rest[file.write(rest) :]
            if sync:
                os.fsync(file.fileno())
        rename(temporary, path)
    except BaseException:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)
        raise


def to_disk(path: Path) -> None:
    """Wait until a file or folder is on disk."""
    handle = os.open(path, os.O_RDONLY if path.is_dir() else os.O_RDWR)  # Windows syncs only what may be written
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _reason(path: Path, error: Exception) -> str:
    """Say why an output could not be written."""
    reason = getattr(error, "strerror", None) or str(error)
    with suppress(OSError, RuntimeError):
        free = shutil.disk_usage(path.resolve().parent).free
        if free < 2**20:
            reason = f"{reason}; {bytes_in_words(free)} are free on its disk"
    return (
        f"{path}: cannot be written ({reason}); any earlier file is untouched; "
        "free some space or get write permission, or name another output with -o"
    )
