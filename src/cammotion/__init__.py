"""Cam motion and machine timing."""
