"""The workbook as a folder of pages: read and played with no kernel and no network.

`build` makes the pages from stored notebooks, `folder` writes them, `__main__` is the command.
"""
