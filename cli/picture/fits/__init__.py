"""Pictures of fits: of one loop, of several, and of a measured profile."""
