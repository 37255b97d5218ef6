"""All that the waves and the power of a profile contribute to a curve, tabulated: universal functions of k and radius."""
