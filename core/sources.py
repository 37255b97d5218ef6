"""A digest of all sources of the core: what is computed by one of them is comparable bit by bit."""

import hashlib
from pathlib import Path
from typing import Final

CORE: Final = Path(__file__).parent


def digest_of(folder: Path) -> str:
    """Return a digest of the names and the bytes of all Python files of a folder."""
    digest = hashlib.sha256()
    for source in sorted(folder.rglob("*.py")):
        digest.update(source.relative_to(folder).as_posix().encode())
        digest.update(source.read_bytes())
    return digest.hexdigest()


SOURCES: Final = digest_of(CORE)
"""The digest of the core, wherever it stands."""
