"""Studies of kind "fit": their form, their rules, and the measured loops that they name."""
