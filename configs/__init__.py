"""The studies that come with the program, for `gradhesion init`."""
