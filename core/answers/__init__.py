"""Answers beyond a map of values, from arrays to arrays without a kernel: fits of measured data, and spectra."""
