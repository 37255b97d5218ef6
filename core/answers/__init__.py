"""Answers that take many scenes, or a search: arrays in, arrays out."""
