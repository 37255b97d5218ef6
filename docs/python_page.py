"""The page of the public names of Python, from their signatures and docstrings: readable where the repository is."""

import importlib
import inspect
import re
from collections.abc import Iterator
from functools import cached_property
from typing import Any, Final

import gradhesion
from docs.tables import code, table
from gradhesion import accessor, core
from gradhesion.cli import dataset, study

NAMES: Final = {
    "PARAMETERS": "the parameters of a scene, each with its meaning",
    "OUTPUTS": "the outputs of `gr.solve`, each with its meaning",
    "CURVES": "the curves of `gr.curves`: the variables of each, with their meanings",
    "FLAGS": "the flags of `status`, with their bits",
    "SOLVERS": "the words for `solver`",
    "CONTROLS": "the words for `control`",
    "__version__": "the version of the program",
}
"""The constants of the package, with what they are."""

SECTIONS: Final = re.compile(r"^([A-Z][a-z]+)\n-{3,}\n", re.MULTILINE)
"""The heads of the sections of a docstring."""

MEMBERS: Final = {"Study": ("variables", "given", "sizes", "axes", "shape", "scenes", "sha256")}
"""The members of a class that scripts use, where it has others for the program itself."""

ANSWERS: Final = (
    ("answers.profile_fit", "fit_profile"),
    ("answers.profile_fit", "FittedProfile"),
    ("loops.fit", "fit_loop"),
    ("loops.fitted", "FittedLoop"),
    ("answers.spectrum", "Spectrum"),
    ("answers.spectrum", "random_profile"),
)
"""Functions of `core`, by their modules."""


def page() -> str:
    """Write the page."""
    return "\n\n".join(_sections())


def _sections() -> Iterator[str]:
    """Write the sections."""
    gr = "gr"
    yield "# Python reference"
    yield (
        "This page is generated from the docstrings. `import gradhesion as gr` turns parameters or a study into an "
        "`xarray.Dataset`. Names are imported on first use, so the import itself takes no time. [Scenes and "
        "datasets](../scenes.md#in-python) shows them at work. Behind it are two layers with the same names: "
        "`gradhesion.core` takes and returns arrays, `gradhesion.cli` reads studies and makes datasets."
    )
    yield "## Solve and draw scenes"
    for name in ("solve", "curves", "Profile", "Harmonic"):
        yield from _of(gr, name, getattr(gradhesion, name))
    yield "## Studies"
    for name in ("load", "run", "Study"):
        yield from _of(gr, name, getattr(gradhesion, name))
    yield "## Datasets"
    for name in ("open", "verify", "plot", "explore"):
        yield from _of(gr, name, getattr(gradhesion, name))
    yield "## The accessor dataset.gr"
    yield "xarray datasets have it from the first call of a function of `gr` (from the import, if xarray comes first)."
    yield from _of("", "dataset.gr", accessor.Accessor)
    yield "## Names"
    yield table(("name", "what it is"), ([code(f"gr.{name}"), words] for name, words in NAMES.items()))
    yield "## Errors"
    yield (
        "Errors are plain exceptions with the list of their `mistakes`, each a sentence that names the key and the "
        "remedy; the command line prints the same sentences."
    )
    errors = ("GradhesionError", "StudyError", "DatasetError", "OutputError", "MissingExtraError")
    yield table(("error", "raised when"), ([code(f"gr.{name}"), _first(getattr(gradhesion, name))] for name in errors))
    yield "## Arrays: gradhesion.core"
    for name in ("solve", "validity", "draw_curves", "Loading", "doubts_about"):
        yield from _of("core", name, getattr(core, name))
    for module, name in ANSWERS:
        home = importlib.import_module(f"gradhesion.core.{module}")
        yield from _of(f"core.{module}", name, getattr(home, name))
    yield (
        "`PARAMETERS`, `OUTPUTS`, `REPORTS`, `CURVES`, `SOLVERS` and `CONTROLS` name what these take, `FLAGS`, "
        "`DOUBTFUL` and `FAILED` the bits of a status. The paper's equations one by one are in "
        "`gradhesion.core.equations`: [the paper](../paper.md). For programs that compile ahead:"
    )
    ahead = ("warm_up", "place")
    yield table(("function", "what it does"), ([code(f"core.{name}"), _first(getattr(core, name))] for name in ahead))
    yield "## Studies and datasets: gradhesion.cli"
    for name in ("load_study", "study_from", "Method"):
        yield from _of("cli.study", name, getattr(study, name))
    yield from _of("cli.dataset", "compute", dataset.compute)


def _of(module: str, name: str, thing: Any) -> Iterator[str]:
    """Write the section of a function, or of a class with its own public members."""
    called = f"{module}.{name}" if module else name
    yield f"### {called}"
    if not inspect.isclass(thing):
        yield f"```text\n{_signature(called, thing)}\n```"
        yield from _described(thing)
        return
    if called != "dataset.gr":
        yield f"```text\n{_signature(called, thing)}\n```"
    yield from _described(thing)
    for member, value in {name: one for base in reversed(thing.__mro__) for name, one in vars(base).items()}.items():
        attribute = isinstance(value, property | cached_property)
        own = {property: "fget", cached_property: "func"}.get(type(value), "__func__")
        function = getattr(value, own, value)
        if member.startswith("_") or not (inspect.isfunction(function) and function.__doc__):
            continue
        if member not in MEMBERS.get(thing.__name__, (member,)):
            continue
        yield f"#### {called}.{member}"
        if not attribute:
            yield f"```text\n{_signature(f'{called}.{member}', function)}\n```"
        yield from _described(function)


def _signature(called: str, function: Any) -> str:
    """Write how something is called, without types; the words say them."""
    signature = inspect.signature(function)
    parameters = [one.replace(annotation=one.empty) for one in signature.parameters.values() if one.name != "self"]
    plain = signature.replace(parameters=parameters, return_annotation=signature.empty)
    text = f"{called}{plain}"
    if len(text) <= 100:
        return text
    words = [str(plain.replace(parameters=[one]))[1:-1] for one in parameters if one.kind != one.KEYWORD_ONLY]
    keywords = [str(one) for one in parameters if one.kind == one.KEYWORD_ONLY]
    last = [word for word in words if word.startswith("**")]
    lines = [*(word for word in words if word not in last), *(["*"] if keywords else []), *keywords, *last]
    return f"{called}(\n" + "".join(f"    {line},\n" for line in lines) + ")"


def _described(thing: Any) -> Iterator[str]:
    """Write a docstring of numpy's style as Markdown."""
    text = inspect.getdoc(thing) or ""
    first, *rest = SECTIONS.split(text)
    yield _with_code(first.strip())
    for head, body in zip(rest[::2], rest[1::2], strict=True):
        yield f"**{head}**"
        yield _listed(body) if head in ("Parameters", "Raises", "Attributes") else _with_code(body.strip())


def _listed(body: str) -> str:
    """Write the entries of a section as a list."""
    entries = re.split(r"\n(?=\S)", body.strip())
    items = []
    for entry in entries:
        names, _, words = entry.partition("\n")
        name = ", ".join(code(one.strip()) for one in names.partition(" : ")[0].split(","))
        lines = inspect.cleandoc(words).splitlines()
        items.append("\n".join([f"- {name}: {lines[0] if lines else ''}", *("  " + line for line in lines[1:])]))
    return "\n".join(line.rstrip() for line in "\n".join(items).splitlines())


def _with_code(text: str) -> str:
    """Put examples between fences."""
    paragraphs = []
    for paragraph in text.split("\n\n"):
        if paragraph.startswith(">>> "):
            paragraph = f"```pycon\n{paragraph}\n```"
        paragraphs.append(paragraph)
    return "\n\n".join(paragraphs)


def _first(thing: Any) -> str:
    """Take the first sentence of a docstring."""
    return " ".join((inspect.getdoc(thing) or "").partition("\n\n")[0].split())
