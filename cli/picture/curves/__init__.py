"""Pictures of the curves of scenes and of the states of contact, with measured points."""
