"""The form of a study, and what its keys have to do with each other: a module a subject."""
