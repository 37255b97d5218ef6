"""Pictures of datasets by matplotlib: lines, maps, panels, points and curves."""
