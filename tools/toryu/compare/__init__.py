"""Lays two runs over each other: what they set otherwise, how far their series lie apart, charts, a page."""
