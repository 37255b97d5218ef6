"""The command `gradhesion`, which is `python -m gradhesion` as well."""

import sys
from typing import NoReturn

from gradhesion.cli.installation import misfit


def main() -> NoReturn:
    """Run the command line, if the packages that it needs at once are there."""
    try:
        from gradhesion.cli.main import main as run
    except (ImportError, AttributeError, TypeError) as error:
        if (found := misfit(error)) is not None:
            sys.stderr.write(f"{found}\n")
            sys.exit(found.exit_code)
        raise
    run()


if __name__ == "__main__":
    main()
