"""Hard cases of gases and liquids, for hard.py: scenes, methods, criteria."""

CASES = []
