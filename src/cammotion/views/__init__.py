"""What is seen: plots, live figures, the machine in motion."""
