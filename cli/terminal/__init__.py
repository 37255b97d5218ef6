"""What is printed: messages, progress, what was meant, and how an interrupt is heard."""
