"""What a wrong answer would do: it is put into the machine, and drawn beside a line in words.

`turns`, `ways`, `places` and `bars` each hold a few kinds, which an exercise names in `shows`.
"""
