"""Analyses beyond a map of values, without kernels: optima, uncertain inputs, random profiles, measured profiles."""
