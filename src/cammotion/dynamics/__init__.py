"""What moves beyond the law: a follower that gives way and swings.

It takes the acceleration of a law as it is written, and answers in expressions too.
"""
