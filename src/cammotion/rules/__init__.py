"""Rules: what the mechanisms of a machine may not do at once, and where a diagram does it.

A rule says so of two of them; `checks` asks all rules alike, whatever kind each is.
"""
