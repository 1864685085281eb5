"""Files in and out: diagrams as tables that a spreadsheet opens."""
