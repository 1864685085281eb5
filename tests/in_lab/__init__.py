"""Notebooks in one JupyterLab, in one page of one Chromium, one after the other."""
