"""Parts: the finished blocks of a study, each in a file of its own that is trusted only if all of it is right.

A part is the SHA-256 of all that follows, in hexadecimal, on a line; the key of its block, JSON on a line; and its
arrays one after the other, little-endian, in the order of the key. The key has all that the values depend on, so that
neither the name of a part nor its age matters.
"""

import hashlib
import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict, fields
from importlib.metadata import version
from pathlib import Path
from typing import Any, Final

import numba
import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.disk import write_whole
from gradhesion.cli.files import read_at_most
from gradhesion.cli.names.outputs import ON_BOUND
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.tiling import Block, shape_of
from gradhesion.core import SOURCES

FORMAT: Final = 1
"""To be raised when parts are written in another way, or blocks are solved in another way by `gradhesion.cli`."""

Results = dict[str, NDArray[Any]]


class PartError(ValueError):
    """A part is damaged, or of another block; the message says which."""


def versions() -> dict[str, Any]:
    """List the versions that values depend on: another one may round another way."""
    return {"format": FORMAT, "gradhesion": version("gradhesion"), "core": SOURCES, "numba": numba.__version__}


def settings_of(study: Study) -> dict[str, Any]:
    """List all that a study asks for but its parameters; not what it is called, nor how it is written."""
    aside = (
        "name",
        "title",
        "text",
        "parameters",
        "method",
        "left_out",
        "chunk",
        "folder",
        "points",
        "measured",
        "spectrum",
        "uncertainty",
        "search",
    )
    settings = {field.name: getattr(study, field.name) for field in fields(study) if field.name not in aside}
    settings |= {name: repr(own) for name, own in (("uncertainty", study.uncertainty), ("search", study.search)) if own}
    if study.spectrum is not None:
        settings |= {f"spectrum.{name}": value for name, value in asdict(study.spectrum).items()}
        del settings["spectrum.realisations"]  # each of them is the same however many there are
    return settings | {f"method.{name}": value for name, value in asdict(study.method).items()}


def types_of(study: Study) -> dict[str, np.dtype[Any]]:
    """Give the types of the results of a map, in the order of a part."""
    types = {name: "<i4" if name.endswith("_jumps") else "<f8" for name in study.variables}
    types |= {ON_BOUND: "|i1"} if ON_BOUND in types else {}
    types |= {STEEP: "|i1"} if study.watches_slope else {}
    return {name: np.dtype(kind) for name, kind in (types | {"status": f"<{study.status_type}"}).items()}


def bytes_of(study: Study, block: Block) -> int:
    """Count the bytes of the values of a block."""
    shape = shape_of(block)
    return sum(kind.itemsize * math.prod(study.shape_of(name, shape)) for name, kind in types_of(study).items())


def key_of(study: Study, block: Block) -> str:
    """Write down all that the values of a block depend on."""
    several, axes, _ = study.apart(block)
    digest = hashlib.sha256()
    for name, values in study.parameters_of(axes).items():
        digest.update(f"{name} {values.shape} ".encode())
        digest.update(np.ascontiguousarray(values, "<f8").tobytes())
    key = versions() | settings_of(study)
    if several:
        key["method.solver"] = study.method.solver[several[0]]
    if study.spectrum is not None:
        key["realisations"] = [block[-1].start, block[-1].stop]
    key["values"] = {name: kind.str for name, kind in types_of(study).items()}
    key["shape"] = list(shape_of(block))
    key["parameters"] = digest.hexdigest()
    return json.dumps(key, default=str)


def write_part(path: Path, key: str, values: Mapping[str, NDArray[Any]], study: Study) -> None:
    """Write the values of a block to disk, whole or not at all."""
    pieces = [memoryview(f"{key}\n".encode())]
    pieces += [np.ascontiguousarray(values[name], kind).data.cast("B") for name, kind in types_of(study).items()]
    write_whole(path, f"{digest_of(pieces)}\n".encode(), *pieces)


def digest_of(pieces: Iterable[memoryview]) -> str:
    """Return the SHA-256 of all pieces in turn, in hexadecimal: what takes longest of a part that is written."""
    digest = hashlib.sha256()
    for piece in pieces:
        digest.update(piece)
    return digest.hexdigest()


def read_part(path: Path, key: str, study: Study, block: Block) -> Results:
    """
    Read the values of a block from its part.

    Raises
    ------
    PartError
        It is damaged, or belongs to another block.
    OSError
        It cannot be read.
    """
    content = read_at_most(path, 2**20 + 2 * (len(key) + bytes_of(study, block)))
    head = content.find(b"\n") + 1
    if not head or hashlib.sha256(memoryview(content)[head:]).hexdigest() != content[: head - 1].decode("latin-1"):
        raise PartError("damaged")
    at = content.find(b"\n", head) + 1
    if content[head : at - 1] != key.encode():
        raise PartError("of other scenes or another version")
    shape = shape_of(block)
    if len(content) != at + bytes_of(study, block):
        raise PartError("damaged")
    values = {}
    for name, kind in types_of(study).items():
        own = study.shape_of(name, shape)
        values[name] = np.frombuffer(content, kind, math.prod(own), at).reshape(own)
        at += values[name].nbytes
    return values
