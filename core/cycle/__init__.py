"""One cycle on a curve: loading, unloading, the pull-off, where it turns, whether the contact is one disc."""
