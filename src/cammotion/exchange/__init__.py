"""Files in and out: machines and cams as tables for a spreadsheet, a controller, a workshop.

Three families have their own word in front, and stand on what all share.

`machine_files` reads and writes a whole machine and `diagram_tables` its segments and curves. Both
read by `machine_table`, which makes a machine of lines and tells all faults at once:
`machine_source` gets the rows from CSV, a workbook or a text, `machine_heading` finds the columns,
`machine_lines` reads a line of them, and `machine_rules` the rules and still arcs.

`cam_tables_in` reads the table of one cam from any program: `cam_table_text` finds its lines,
`cam_table_columns` cuts them into what `cam_table_cut` describes, `cam_table_marks` asks of commas
and points what else they may mean, `cam_table_headings` reads the words over a column, and
`cam_table_meaning` says what both columns are. `cam_tables_out` writes tables for a controller, and
`cam_files` the cam itself for the workshop.

`law_text` writes a motion law and reads it back, `expression_text` its formula, and `rule_text`
rules and still arcs. Below all: `table_numbers` (a number as it is written), `cells` (numbers and
names in a cell), `other_units` (what makes mm of inches), `xlsx_in`, `xlsx_out` and `all_faults`.
"""
