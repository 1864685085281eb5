"""What a machine asks of its camshaft.

`camshaft` says which force each mechanism takes, and which torque the shaft; `rates` at which rate
a limit is met. `spans` is the turn, cut wherever a motion is not smooth.
"""
