"""Gamma: the response of monitors, its correction, and what is lost on the way (book 5.1.2)."""
