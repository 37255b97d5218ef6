"""The page that `gradhesion explore` writes: its data, its figures and what moves them."""
