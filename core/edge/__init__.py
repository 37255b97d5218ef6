"""The edge of the contact: a toughness that varies with the radius, and a work of adhesion that grows with its speed."""
