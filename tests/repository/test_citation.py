"""The citation file agrees with the project."""

import tomllib
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]

CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))


def test_the_citation_is_that_of_the_project() -> None:
    assert (CITATION["cff-version"], CITATION["type"]) == ("1.2.0", "software")
    assert {"message", "title", "authors"} <= CITATION.keys()
    assert (CITATION["version"], CITATION["license"]) == (PROJECT["version"], PROJECT["license"])
    assert CITATION["keywords"] == PROJECT["keywords"]


def test_the_paper_is_cited_as_the_program_cites_it() -> None:
    from gradhesion.cli.names.scenes import REFERENCES

    (paper,) = CITATION["references"]
    names = [author["family-names"] for author in paper["authors"]]
    assert f"{', '.join(names[:-1])} & {names[-1]} ({paper['year']}), {paper['title']}" in REFERENCES
