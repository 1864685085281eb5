"""How good any motion could get: the widest move, and the least acceleration.

An answer is checked before it is given: a motion is found on a grid, and then looked at like any.
"""
