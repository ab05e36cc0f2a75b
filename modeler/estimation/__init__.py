"""Estimators of the base parameters, their certainty, the verdict of a fit, and the model file."""
