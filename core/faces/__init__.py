"""The answers of each kind of curve to core/face.py: a file for each kind, and one for its sensitivities."""
