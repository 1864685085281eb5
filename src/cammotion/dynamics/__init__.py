"""What moves beyond the law: a follower that gives way and swings, or leaves its cam.

It gives way: `chain` is what it is made of; `forcing`, `flow` and `course` make its state from what
drives it, `response` asks that, `residual` with `swing` for many ratios at once, and `one_mass` is
the formula. It leaves: `loads` press it on, `flight` and `turns` follow it, `contact` asks them.
"""
