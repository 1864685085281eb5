"""Teaching: the example and its variants, questions, answers checked with reasons, progress."""
