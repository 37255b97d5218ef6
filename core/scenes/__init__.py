"""Arrays of scenes: their reduced numbers, the loops over them, and the results that are made of theirs."""
