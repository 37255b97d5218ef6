"""Numbers that kernels compute with: lanes of eight, double-double sums, exact circles, Chebyshev coefficients."""
