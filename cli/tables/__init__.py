"""Tables of numbers in files: one reader for points, measured loops, profiles, and points on a picture."""
