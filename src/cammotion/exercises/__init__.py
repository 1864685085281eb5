"""Exercises: numbers of one's own, answers checked with reasons, hints, and what is done."""

from cammotion.exercises.desk import ask, check, choose, hint, predict, progress, variant

__all__ = ["ask", "check", "choose", "hint", "predict", "progress", "variant"]
