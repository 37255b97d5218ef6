"""Folders of parts that are changed at random: small files, parts with right checksums and wrong contents, links."""

import hashlib
import json
import random
from pathlib import Path
from typing import Any

ODD: tuple[Any, ...] = (
    None,
    True,
    -1,
    0,
    0.5,
    1e300,
    2**70,
    "",
    "x\x1b[1m",
    [],
    {},
    [1, 2],
    [[[]]],
    {"k": None},
    "NaN",
)


def mutate(folder: Path, draw: random.Random) -> str:
    """Change something in a folder, and say what."""
    path = draw.choice(sorted(folder.iterdir()) or [folder / "lock"])
    change = draw.choice((_bytes, _bytes, _json, _json, _json, _checksum, _checksum, _link, _folder, _without, _other))
    return f"{path.name}: {change(path, draw)}"


def _bytes(path: Path, draw: random.Random) -> str:
    content = bytearray(path.read_bytes()) if path.is_file() else bytearray()
    if not content or draw.random() < 0.3:
        path.write_bytes(bytes(content[: len(content) // 2])) if path.is_file() else None
        return "cut"
    content[draw.randrange(len(content))] ^= 1 << draw.randrange(8)
    path.write_bytes(content)
    return "a bit"


def _json(path: Path, draw: random.Random) -> str:
    if path.suffix != ".json" or not path.is_file():
        return _bytes(path, draw)
    try:
        content = json.loads(path.read_bytes())
    except ValueError:
        return "no JSON any more"
    odd, where = draw.choice(ODD), content
    while isinstance(where, dict) and where:
        key = draw.choice(sorted(where))
        if isinstance(where[key], dict) and where[key] and draw.random() < 0.5:
            where = where[key]
            continue
        where[key] = odd
        break
    else:
        content = odd
    path.write_text(json.dumps(content))
    return f"has {odd!r}"


def _checksum(path: Path, draw: random.Random) -> str:
    """Cut the values of a part, or add to them, and make its checksum right."""
    if path.suffix != ".part" or not path.is_file():
        return _json(path, draw)
    rest = path.read_bytes()[65:]
    rest = (
        draw.choice([rest[: draw.randrange(len(rest) + 1)], rest + b"\0" * 8, b"", b"\n", rest[:-8]]) if rest else rest
    )
    path.write_bytes(hashlib.sha256(rest).hexdigest().encode() + b"\n" + rest)
    return "another length, with its checksum"


def _link(path: Path, draw: random.Random) -> str:
    _without(path, draw)
    path.symlink_to(draw.choice(["nowhere", path.name, "/dev/zero", "/dev/null", "/", "study.json", "/proc/self/mem"]))
    return f"a link to {path.readlink()}"


def _folder(path: Path, draw: random.Random) -> str:
    _without(path, draw)
    path.mkdir()
    return "a folder"


def _without(path: Path, _draw: random.Random) -> str:
    if path.is_dir() and not path.is_symlink():
        path.rmdir()
    else:
        path.unlink(missing_ok=True)
    return "removed"


def _other(path: Path, draw: random.Random) -> str:
    name = draw.choice(
        [
            "finished.json",
            "000001.part",
            "state.json",
            "lock",
            "merged.nc",
            "state-1-of-2.json",
            "lock-1-of-2",
            "1e9.part",
            "9" * 40 + ".part",
        ]
    )
    other = path.parent / name
    _without(other, draw)
    other.write_text(draw.choice(["", "{}", "null", '{"file": null}', "[" * 10**5, "x"]))
    return f"{name} beside it"
