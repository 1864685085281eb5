"""What moves beyond the law: a follower that gives way and swings.

A mass on a spring or a row of them, driven by a law or a motion: expressions and exact numbers.
"""
