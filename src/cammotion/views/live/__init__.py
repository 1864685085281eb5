"""Live figures: SymPy expressions under the reader's hand, with or without a kernel.

`explore` reads what the learner gives, `parts` are what a figure is made of, `describe` turns them
into one description, whose `formulas` are JavaScript and Python alike. `formulas.js`, `panel.js`,
`controls.js` and `figure.js` draw a description in a notebook and in a `page`; `picture` draws it
for a reader who has neither.
"""
