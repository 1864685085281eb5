"""A whole machine at once: the best diagram of its moves, and what no other could be below.

`optimise` finds starts, angles and laws of all moves, by a program in `move_program`, which
`wide_moves` solves for one peak after the other; for the torque `torque_search` goes down within
it. `least_peak` bounds what any motions of the parts could reach: `joint_bound` asks from below,
`joint_motion` builds from above, `joint_search` makes their grids finer.
"""
