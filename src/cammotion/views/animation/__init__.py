"""The machine in motion: one SVG, and its player in the lab."""

from cammotion.views.animation.picture import Animation, animate

__all__ = ["Animation", "animate"]
