"""One wave far out on a curve, and sums over many."""
