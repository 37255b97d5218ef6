"""The manual does what it says: its commands and examples are run."""
