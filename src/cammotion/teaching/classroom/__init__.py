"""The class at a glance: one page of what the students' progress files hold.

`collect` reads the files, `tally` counts, `histogram` draws, `page` writes, and ``__main__`` is
what ``workbook.py class`` runs. Nothing is served, and no file of a student is changed.
"""
