"""Simulated measurements of random arms with a physical effect hidden in them, and their score.

The generator imports nothing of the package that is tested; `tests/chain.py` alone does.
"""
