"""Commands for an installation, a shell and an editor: `gradhesion warmup`, `completion` and `schema`."""

import json
import time

import click
from click.shell_completion import ShellComplete, get_completion_class

from gradhesion.cli.commands.shared import example, quietly
from gradhesion.cli.terminal import messages


@click.command(epilog=example("warmup --all"))
@click.option("--all", "everything", is_flag=True, help="Other profiles, controls and reports too.")
@click.option("--workers", type=click.IntRange(min=1), hidden=True, help="Without effect: one process compiles.")
@quietly
def warmup(everything: bool, workers: int | None) -> None:  # noqa: ARG001 (accepted, and without effect)
    """Compile the solver ahead of the first run.

    Runs compile what they need on first use. Without --all, only what maps and curves of a paraboloid with one cosine
    wave need is compiled. It is kept in the user's cache, or in the folder NUMBA_CACHE_DIR, for all runs of this
    version.
    """
    from gradhesion.cli.work.compiling import SECONDS, alone, refuse_without_compiler
    from gradhesion.core import place

    refuse_without_compiler()
    from gradhesion.core import warm_up  # it imports kernels, which need the compiler

    start = time.monotonic()
    with alone(*(SECONDS if everything else ("forces", "energies", "curves"))):
        warm_up(lambda kind, seconds: messages.note(f"{kind}: {seconds:.1f} s"), everything=everything)
    where = f", kept in {place().folder}" if place().folder else ""
    messages.note(f"all compiled in {time.monotonic() - start:.0f} s{where}")


@click.command(epilog=example("completion bash > ~/.gradhesion.bash", "completion zsh", "completion fish"))
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
@click.pass_context
def completion(context: click.Context, shell: str) -> None:
    """Print the script for completion in a shell.

    SHELL is bash (4.4 or later), zsh or fish. It then completes commands, options and the names of studies. Load the
    script in the start-up file of the shell, for example with `eval "$(gradhesion completion bash)"` in ~/.bashrc.
    """
    kind = get_completion_class(shell) or ShellComplete  # each of these shells is one of click's own
    made = kind(context.find_root().command, {}, "gradhesion", "_GRADHESION_COMPLETE")
    messages.show_block(ShellComplete.source(made))  # that of bash looks for a bash first


@click.command(epilog=example("schema > study.schema.json"))
def schema() -> None:
    """Print the JSON Schema of a study.

    Editors use it to complete and check studies; `run` and `validate` use it too. What it cannot express (lists of
    unequal length, repeated values) is checked by `gradhesion validate`.
    """
    from gradhesion.cli.study.rules.form import Form

    document = {"$schema": "https://json-schema.org/draft/2020-12/schema", **Form.model_json_schema()}
    messages.show_block(json.dumps(document, indent=2))
