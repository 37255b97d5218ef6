"""What valid studies of all kinds have."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gradhesion.cli.study.rules.form import Form
from gradhesion.cli.study.text.toml import Key, Source, with_fingerprints
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.toughness import Rate, Toughness


@dataclass(frozen=True, kw_only=True, eq=False)
class Given:
    """What a valid study of any kind has."""

    name: str
    title: str
    text: str
    """The study as TOML: reading it again gives the same study."""
    kind: str
    profile: Profile = field(default_factory=Profile)
    loading: Loading = field(default_factory=Loading)
    toughness: Toughness | None = None
    rate: Rate | None = None
    folder: Path = Path()
    """The folder of the files that it names."""

    @property
    def sha256(self) -> str:
        """The fingerprint of its text."""
        return hashlib.sha256(self.text.encode()).hexdigest()


def given_by(source: Source, form: Form, fingerprints: Mapping[Key, str]) -> dict[str, Any]:
    """Make what studies of all kinds have of a form that is right, with the fingerprints of its files."""
    return {
        "name": source.name,
        "title": form.title or source.name,
        "text": with_fingerprints(source.data, source.text, fingerprints),
        "kind": form.kind,
        "toughness": form.toughness.made() if form.toughness else None,
        "folder": source.folder,
    }
