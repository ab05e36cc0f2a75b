"""The catalogue of physical effects, each defined once."""
