"""Analyses beyond a map of values, arrays in and arrays out, without kernels: fits of measured data, and spectra."""
