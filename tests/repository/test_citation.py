"""The citation file follows the Citation File Format 1.2.0 in all that it uses, and agrees with the project."""

import tomllib
from pathlib import Path
from typing import Any

import yaml

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]

ENTITY = {"name": str, "alias": str, "website": str, "email": str}
PERSON = {"family-names": str, "given-names": str, "affiliation": str, "orcid": str}
SOFTWARE = {
    "cff-version": str,
    "message": str,
    "type": str,
    "title": str,
    "version": str,
    "license": str,
    "authors": list,
    "keywords": list,
    "references": list,
    "abstract": str,
    "date-released": str,
    "doi": str,
    "repository-code": str,
    "url": str,
}
REFERENCE = {
    "type": str,
    "title": str,
    "authors": list,
    "year": int,
    "journal": str,
    "volume": int,
    "issue": str,
    "start": int,
    "end": int,
    "doi": str,
}
"""The keys of the format's schema that a citation of a program is made of, with their types."""


def _check(entry: dict[str, Any], allowed: dict[str, type], required: tuple[str, ...]) -> None:
    assert entry.keys() >= {*required}
    for key, value in entry.items():
        assert isinstance(value, allowed[key]), key
        assert value, key
    for author in entry.get("authors", ()):
        _check(author, ENTITY if "name" in author else PERSON, ())


def test_the_citation_is_valid_and_that_of_the_project() -> None:
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    _check(citation, SOFTWARE, ("cff-version", "message", "title", "authors"))
    assert citation["cff-version"] == "1.2.0"
    assert citation["type"] == "software"
    for reference in citation["references"]:
        _check(reference, REFERENCE, ("authors", "title", "type"))
    assert len({*citation["keywords"]}) == len(citation["keywords"])
    assert (citation["version"], citation["license"]) == (PROJECT["version"], PROJECT["license"])
    assert citation["keywords"] == PROJECT["keywords"]


def test_the_paper_is_cited_as_the_program_cites_it() -> None:
    from gradhesion.cli.names.scenes import REFERENCES

    (paper,) = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))["references"]
    names = [author["family-names"] for author in paper["authors"]]
    assert f"{', '.join(names[:-1])} & {names[-1]} ({paper['year']}), {paper['title']}" in REFERENCES
