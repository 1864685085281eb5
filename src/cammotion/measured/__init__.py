"""Tables of a cam, measured or printed: their differences, their harmonics, their smoothing.

A table has a reading error. Each answer here comes with what that error makes of it.
"""
