"""The work of a study: its blocks, their kernels, and the parts that a run keeps until its dataset is whole."""
