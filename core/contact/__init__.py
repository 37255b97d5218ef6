"""Whether contact is one disc: the gap outside it, of one cosine and of any profile."""
