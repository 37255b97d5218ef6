"""What the waves and the power of a profile contribute to a curve, tabulated over the radius."""
