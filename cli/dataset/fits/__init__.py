"""The datasets of fits: what they hold, and what is to be said of them."""
