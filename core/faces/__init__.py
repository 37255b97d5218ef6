"""What each kind of curve answers to core/face.py: a file a kind, and one of its sensitivities."""
