"""The page of every command with its options, from the tree of commands itself."""

from collections.abc import Iterator

import click

from docs.tables import code, table
from gradhesion.cli.errors import EXIT_CODES
from gradhesion.cli.main import cli


def page() -> str:
    """Write the page."""
    sections = [section for name, command in cli.commands.items() for section in _of(name, command)]
    return "\n\n".join(
        [
            "# Commands and options",
            "This page is generated from the commands; `gradhesion COMMAND --help` prints the same.",
            table(
                ("command", "what it does"),
                ([f"[{name}](#gradhesion-{name})", _first(one)] for name, one in cli.commands.items()),
            ),
            *sections,
            "## Exit codes",
            table(("exit code", "meaning"), ([str(number), words] for number, words in EXIT_CODES.items())),
            "Data goes to files, requested information to stdout, and all messages to stderr.",
        ]
    )


def _of(name: str, command: click.Command) -> Iterator[str]:
    """Write the section of a command."""
    context = click.Context(command, info_name=f"gradhesion {name}")
    yield f"## gradhesion {name}"
    yield f"```text\n{context.command_path} {' '.join(command.collect_usage_pieces(context))}\n```"
    yield _help_of(command)
    if command.epilog:
        calls = "\n".join(line.strip() for line in command.epilog.splitlines()[2:])
        yield f"```text\n{calls}\n```"
    options = [option for option in command.params if isinstance(option, click.Option)]  # `--help` is none
    records = [option.get_help_record(context) for option in options]
    rows = [[code(record[0]), record[1]] for record in records if record]  # None for what is hidden
    if rows:
        yield table(("option", "what it does"), rows)


def _help_of(command: click.Command) -> str:
    """Take the help of a command out of its indentation."""
    return "\n\n".join(" ".join(part.split()) for part in (command.help or "").split("\n\n"))


def _first(command: click.Command) -> str:
    """Take the first sentence of the help of a command."""
    return _help_of(command).partition("\n\n")[0]
