"""Arrays of scenes: grouped by what they share, and spread over threads."""
