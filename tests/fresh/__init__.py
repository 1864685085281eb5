"""Machines drawn anew each time, and every solver held to one that knows nothing of it.

`drawing` draws a machine as code; `sampling` says where its parts are, by plain NumPy; each check
in the modules `check_...` takes a machine and asserts; `runner` goes on
until the time is up. `python3 workbook.py test --fresh` starts it.
"""
