"""What is seen: plots, live figures, the machine in motion. Only this room and `teaching` draw."""
