"""Digests of the sources of the core: values from the same sources are comparable bit for bit."""

import hashlib
from pathlib import Path
from typing import Final

CORE: Final = Path(__file__).resolve().parents[1]
"""Where it stands, the same by whatever link: compiled code belongs to one place."""


WITHOUT_KERNELS: Final = ("answers", "arrays", "equations", "variables")
"""The rooms in which nothing is compiled."""


def digest_of(folder: Path, without: tuple[str, ...] = ()) -> str:
    """Return a digest of the names and the bytes of all Python files of a folder, but for some of its folders."""
    digest = hashlib.sha256()
    for source in sorted(folder.rglob("*.py")):
        if source.relative_to(folder).parts[0] in without:
            continue
        digest.update(source.relative_to(folder).as_posix().encode())
        digest.update(source.read_bytes())
    return digest.hexdigest()


SOURCES: Final = digest_of(CORE)
"""The digest of the core, wherever it stands."""
COMPILED: Final = digest_of(CORE, WITHOUT_KERNELS)
"""The digest of what has kernels or is called by those who have."""
