"""Explorers: what the learner changes by hand, drawn and judged at once."""
