"""What drives a machine hardest, and what to change first: every gain is computed and checked."""
