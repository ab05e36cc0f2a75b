"""Logs of machines without a fault, recorded as people record: nothing said of them may be wrong.

The generator imports nothing of the package that is tested; `judge.py` alone does.
"""
