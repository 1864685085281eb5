"""How good any motion could get: the widest move, the quickest, and the least acceleration.

An answer is checked before it is given: a motion is found on a grid, and then looked at like any.
`reserves` says what a motion leaves until a rule breaks, also when mechanisms are off their places.
"""
