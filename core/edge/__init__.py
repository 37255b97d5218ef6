"""The edge of the contact: a toughness that varies with the radius."""
