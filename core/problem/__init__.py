"""What is asked and what is answered: parameters, profiles, controls, materials, results, and the flags of a status."""
