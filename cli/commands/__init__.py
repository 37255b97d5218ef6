"""The commands: each reads its options, calls the rooms that do the work, and prints."""
