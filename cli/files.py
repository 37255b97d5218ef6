"""What a file is, for whoever named it in the place of another."""

import errno
import os
import stat
from pathlib import Path
from typing import Final

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
    """Say what stands at a path, by how it begins and by its name; "" where nothing is known of it.

    >>> kind_of(Path("/"))
    'a directory'
    """
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
    r"""Say what a file is by how it begins; "" where that may be anything.

    >>> kind_by_content(b"PK\x03\x04 and so on")
    'an archive (ZIP, or a workbook)'
    """
    return next((kind for magic, kind in _MAGIC.items() if begins.startswith(magic)), "")
