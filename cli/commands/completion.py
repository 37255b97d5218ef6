"""`gradhesion completion`: the script by which a shell completes commands, options and studies."""

import click
from click.shell_completion import ShellComplete, get_completion_class

from gradhesion.cli.terminal.examples import example
from gradhesion.cli.terminal.output import show_block

SHELLS = ("bash", "zsh", "fish")


@click.command(epilog=example("completion bash > ~/.gradhesion.bash", "completion zsh", "completion fish"))
@click.argument("shell", type=click.Choice(SHELLS))
@click.pass_context
def completion(context: click.Context, shell: str) -> None:
    """Print the script for completion in a shell.

    SHELL is bash (4.4 or later), zsh or fish. It then completes commands, options and the names of studies. Load the
    script in the start-up file of the shell, for example with `eval "$(gradhesion completion bash)"` in ~/.bashrc.
    """
    kind = get_completion_class(shell)
    if kind is None:  # it is one of click's own
        raise click.UsageError(f"{shell}: not a known shell; choose from {', '.join(SHELLS)}")
    made = kind(context.find_root().command, {}, "gradhesion", "_GRADHESION_COMPLETE")
    show_block(ShellComplete.source(made))  # that of bash looks for a bash first
