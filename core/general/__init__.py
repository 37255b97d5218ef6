"""Any power for the punch, any Fourier series for its waves, any control of its loading."""
