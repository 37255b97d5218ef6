"""`python -m gradhesion` is the command `gradhesion`."""

from gradhesion.cli.main import main

main()
