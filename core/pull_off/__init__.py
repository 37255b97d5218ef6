"""The pull-off force."""
