"""The text of a study: TOML with its lines, quantities with units, and values of other packages."""
