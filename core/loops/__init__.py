"""Parameters from measured loops of load and depth, from arrays to records."""
