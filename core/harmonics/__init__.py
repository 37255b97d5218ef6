"""The waves of a profile at one radius: sums over its harmonics, and tables for series of many."""
