"""A dataset in words and as a table: what `gradhesion info` prints."""
