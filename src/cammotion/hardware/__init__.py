"""What becomes of a timing diagram: the cam that is cut."""
