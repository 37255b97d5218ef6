"""How strongly force and energy depend on each parameter."""
