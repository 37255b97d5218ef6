"""Pictures of values over scenes: maps, lines, points and Pareto fronts."""
