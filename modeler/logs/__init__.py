"""Logs as people have them: many formats, any names and units, as named columns in ours."""
