"""Curves over [0, 1]: in zones, as series, with every turn of them found; laws stand on these."""
