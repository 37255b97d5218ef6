"""What the keys of a study have to do with each other, a module for each subject."""
