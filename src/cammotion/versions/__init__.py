"""Two versions of a machine: `changes` says what was changed, `comparison` what that cost."""
