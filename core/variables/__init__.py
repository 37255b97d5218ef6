"""Other variables than those of a study: reduced ones, those of similarity, and jumps in the contact radius."""
