"""The command `gradhesion`, which is `python -m gradhesion` as well."""

import sys
from typing import NoReturn

from gradhesion.cli.errors import MissingExtraError
from gradhesion.cli.installation import checked


def main() -> NoReturn:
    """Run the command line, if the packages that it needs at once are there."""
    try:
        with checked():
            from gradhesion.cli.main import main as run
    except MissingExtraError as error:
        sys.stderr.write(f"{error}\n")
        sys.exit(error.exit_code)
    run()


if __name__ == "__main__":
    main()
