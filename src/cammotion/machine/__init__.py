"""The machine: mechanisms that move over the cam angle.

All conversion of units happens in `kinematics`.
"""
