"""Files that somebody has changed, by mistake or on purpose: every command takes them or says what is wrong."""
