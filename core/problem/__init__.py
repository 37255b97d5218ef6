"""The inputs and results of the solver: parameters, profiles, controls, materials, results, and the status bits."""
