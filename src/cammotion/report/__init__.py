"""The report of a machine: one page, a workbook of cam tables, files for the workshop.

`findings` computes all that is said, `page` and `sheets` write it, `writing` puts it into a new
folder, and ``__main__`` is what ``workbook.py report`` runs.
"""
