"""Logs to y = W beta: reading, filtering, decimation, stacking."""
