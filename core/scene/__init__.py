"""From the numbers of one scene to its results and its stated errors."""
