"""How good any motion could get: its corridor, the programs, and the motion that is found."""
