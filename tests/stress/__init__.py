"""The stress suite: scenes far outside the sensible, and what must hold for every one of them."""
