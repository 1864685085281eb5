"""The machine in motion: one SVG, and its player in the lab."""
