"""Estimators against truth and against each other: `python -m tests.estimators --help`."""
