"""The form of a study: which keys there are, which values each takes, and what is wrong with one of them."""
