"""Where a cycle turns before the rim."""
