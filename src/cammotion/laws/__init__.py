"""Motion laws: curves of one variable, the laws made of them, and the catalogue of named ones.

A law is one SymPy expression S(x); velocity, acceleration, peaks and turns are derived from it.
"""
