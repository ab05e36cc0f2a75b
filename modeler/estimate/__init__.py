"""Estimators: from equations y = W beta + rho, or from a model and its logs, to values."""
