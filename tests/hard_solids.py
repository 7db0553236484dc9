"""Hard cases of solids and impacts, for hard.py: scenes, methods, criteria."""

CASES = []
