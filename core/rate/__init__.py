"""An edge whose work grows with its speed: opening and closing as initial-value problems (physics of a moving edge)."""
