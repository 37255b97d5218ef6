"""From a study in TOML to its dataset in NetCDF: the command line, and its parts for notebooks."""
