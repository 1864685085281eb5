"""The machine: mechanisms that move over the cam angle, the rules between them, the widest move.

All conversion of units happens in `kinematics`.
"""
