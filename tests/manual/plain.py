"""The modules that an installation without extras has not: pages for beginners are run without them."""

from importlib.metadata import packages_distributions, requires

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

HIDE = """
import os
from importlib.machinery import PathFinder

find = PathFinder.find_spec

def find_shown(name, path=None, target=None):
    return None if name.partition(".")[0] in os.environ["HIDDEN"].split() else find(name, path, target)

PathFinder.find_spec = staticmethod(find_shown)
"""
"""A sitecustomize.py that hides the modules named in HIDDEN."""


def hidden() -> set[str]:
    """List the modules installed here that the dependencies of gradhesion do not bring along."""
    wanted, needed = ["gradhesion"], {"gradhesion", "pip"}
    while wanted:
        for line in requires(wanted.pop()) or ():
            requirement = Requirement(line)
            name = canonicalize_name(requirement.name)
            if name not in needed and (requirement.marker is None or requirement.marker.evaluate({"extra": ""})):
                needed.add(name)
                wanted.append(name)
    return {
        module
        for module, owners in packages_distributions().items()
        if not needed & {canonicalize_name(owner) for owner in owners}
    }
