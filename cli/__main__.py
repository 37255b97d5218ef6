"""`python -m gradhesion.cli` is `gradhesion`."""

from gradhesion.cli.main import main

main()
