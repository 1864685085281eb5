"""Set the workbook up, open it, test it: what stands behind ``python3 workbook.py``.

Standard library only: this is what makes the environment in which all else is installed.
From the ground up; a module imports only from those above it, and a test holds that:

paths         where everything is, and what we run on
reasons       what installers and systems say, in words of what to do
errors        a foreseen failure, and what the operating system refuses, in words
processes     children: listen to them, wait for them, end them; one of us at a time
download      whether it is whole, and what environment.txt pins
inspection    what is in .venv, and whether it is what the last installation left there
installer     pip or uv at work: how far it is, and in words why it failed
environment   make, update or repair .venv, so that it is ready
notebooks     find, read and write notebooks
folder        where the learner's copies are: in the workbook, or anywhere else
copies        the learner's copies: laid, never overwritten, said to be old
refresh       execute the workbook's own notebooks anew
lab           a port, and JupyterLab on it
browser       say where JupyterLab is, and show it
maintain      run the linters and tests, pin the dependencies
commands      the command line; every foreseen failure ends in a sentence
"""
