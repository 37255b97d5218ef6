"""The universal pair S0, S1: all that the waviness adds to the contact, for every amplitude, wavelength and load."""
