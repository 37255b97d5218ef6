"""What a file is; files that appear whole or not at all, and failures to write in a sentence."""

import errno
import os
import secrets
import shutil
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from itertools import chain, count
from pathlib import Path
from typing import BinaryIO, Final

from gradhesion.cli.errors import OutputError
from gradhesion.cli.terminal.amounts import bytes_in_words

_MAGIC: Final = {
    b"\x89HDF\r\n\x1a\n": "a dataset (NetCDF or HDF5)",
    b"CDF": "a dataset (NetCDF)",
    b"\x89PNG": "a picture (PNG)",
    b"%PDF": "a document (PDF)",
    b"PK\x03\x04": "an archive (ZIP, or a workbook)",
    b"\x1f\x8b": "a compressed file (gzip)",
}
"""How files begin that no text does."""
_ENDINGS: Final = {
    ".toml": "a study (TOML)",
    ".csv": "a table (CSV)",
    ".html": "a page (HTML)",
    ".svg": "a picture (SVG)",
}
"""What files are by their names."""


def read_at_most(path: Path, most: int) -> bytes:
    """Read a file of at most so many bytes (OSError), and no device or pipe, which may have no end or beginning."""
    handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))  # Windows has no such flag
    with os.fdopen(handle, "rb") as file:
        found = os.fstat(handle)
        if not stat.S_ISREG(found.st_mode) or found.st_size > most:
            raise OSError(errno.EINVAL, os.strerror(errno.EINVAL), str(path))
        return file.read(most)


def kind_of(path: Path) -> str:
    """Say what stands at a path, by how it begins and by its name; "" where nothing is known of it."""
    try:
        if path.is_dir():
            return "a directory"
        if not path.is_file():
            return "no regular file" if path.exists() else ""
        with path.open("rb") as file:
            begins = file.read(8)
    except (OSError, ValueError):
        return ""
    return kind_by_content(begins) or _ENDINGS.get(path.suffix.lower(), "")


def kind_by_content(begins: bytes) -> str:
    """Say what a file is by how it begins; "" where that may be anything."""
    return next((kind for magic, kind in _MAGIC.items() if begins.startswith(magic)), "")


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Turn a failure to write into a sentence about `path`."""
    try:
        yield
    except BrokenPipeError:  # of a message, whose reader has gone
        raise
    except (OSError, RuntimeError, UnicodeError) as error:  # RuntimeError is what netCDF4 makes of a failure of HDF5
        reason = getattr(error, "strerror", None) or str(error)
        with suppress(OSError):
            free = shutil.disk_usage(path.resolve().parent).free
            reason += f"; {bytes_in_words(free)} are free on its disk" if free < 2**20 else ""
        remedy = "free some space or get write permission, or name another output with -o"
        raise OutputError(f"{path}: cannot be written ({reason}); any earlier file is untouched; {remedy}") from error


@contextmanager
def rewritten(path: Path) -> Iterator[BinaryIO]:
    """Give a file to write into, which takes the place of `path` when it is whole and on disk."""
    temporary = path.with_name(f"{path.name}.{secrets.token_hex(8)}.tmp")
    try:
        with temporary.open("xb") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


@contextmanager
def replacement(path: Path, *, overwrite: bool) -> Iterator[Path]:
    """Give a temporary file beside `path` that takes its place, complete and on disk, when the body ends.

    If the body fails, or is interrupted, it goes, and what stood at `path` is as it was. OutputError comes at once if
    `path` exists and may not be replaced, or cannot be written; later as `settle` raises it.
    """
    refuse_existing(path, overwrite=overwrite)
    target = Path(os.path.realpath(path))
    # Its name is known before it is made, so that no interrupt comes between the two and leaves it behind.
    temporary = target.with_name(f".{target.name[:100]}.{secrets.token_hex(8)}.part{target.suffix}")
    try:
        with writing(path):
            target.parent.mkdir(parents=True, exist_ok=True)
            temporary.touch(exist_ok=False)
        yield temporary
        settle(temporary, path, overwrite=overwrite)
    finally:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)


def refuse_existing(path: Path, *, overwrite: bool) -> None:
    """Refuse to replace what is not a file, or was not to be replaced (OutputError)."""
    with writing(path):
        exists, is_file = path.exists(), path.is_file()
    if exists and not is_file:
        raise OutputError(f"{path}: is not a file, so it cannot be replaced; name another output with -o")
    if exists and not overwrite:
        raise OutputError(f"{path}: exists already; add --overwrite to replace it, or name another output with -o")


def settle(temporary: Path, path: Path, *, overwrite: bool) -> None:
    """Give a finished file its name as soon as it is on disk; nothing is replaced without `overwrite`.

    OutputError: it cannot be; or something has appeared there meanwhile, and the file is kept under a name beside it.
    """
    target = Path(os.path.realpath(path))
    beside = (target.with_name(f"{target.stem}-{number}{target.suffix}") for number in count(2))
    with writing(path):
        to_disk(temporary)
        for place in chain([target], beside):
            with suppress(FileExistsError, IsADirectoryError):
                temporary.replace(place) if overwrite and place == target else _rename_anew(temporary, place)
                break
    with suppress(OSError):  # some file systems cannot sync a folder
        to_disk(target.parent)
    if place != target:
        kept = f"the new file is complete and kept as {place if path.is_symlink() else path.with_name(place.name)}"
        raise OutputError(f"{path}: appeared during the run and is untouched; {kept}; move it where it belongs")


def _rename_anew(source: Path, target: Path) -> None:
    """Rename a file to a name that nothing has; FileExistsError if something has it."""
    try:
        target.hardlink_to(source)  # the system itself refuses a name that is taken
    except FileExistsError:
        raise
    except OSError:  # a file system without links
        if target.exists():
            raise FileExistsError(target) from None
        source.replace(target)
    else:
        source.unlink()


def to_disk(path: Path) -> None:
    """Wait until a file or folder is on disk."""
    handle = os.open(path, os.O_RDONLY if path.is_dir() else os.O_RDWR)  # Windows syncs only what may be written
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
