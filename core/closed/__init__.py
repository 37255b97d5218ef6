"""Closed forms: the smooth punch, the envelopes of short waves, and where the theory applies."""
