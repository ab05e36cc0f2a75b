"""Pairs of simulated logs between which a machine changed, or did not: is the change named?"""
