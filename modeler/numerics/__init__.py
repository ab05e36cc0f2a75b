"""Least squares, ranks, filters, spectra, noise, splines and descent on plain arrays."""
