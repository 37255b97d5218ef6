"""The names in a dataset, with what they stand for; those of its coordinates are keys of the study."""
