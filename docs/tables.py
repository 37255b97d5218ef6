"""Tables in Markdown, as the generated pages have them."""

from collections.abc import Iterable, Sequence


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    r"""
    Write a table.

    >>> print(table(["key", "meaning"], [["`a|b`", "either"]]))
    | key | meaning |
    | --- | --- |
    | `a\|b` | either |
    """
    lines = [heads, ["---"] * len(heads), *([cell.replace("|", r"\|") for cell in row] for row in rows)]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def code(text: object) -> str:
    """Write something as code, nothing as nothing."""
    return f"`{text}`" if str(text) else ""
