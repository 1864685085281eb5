"""What a wrong answer would do: it is put into the machine, and drawn beside a line in words.

An exercise names a kind in `shows`; `turns`, `ways`, `places`, `bars` and `cams` hold a few each.
"""
