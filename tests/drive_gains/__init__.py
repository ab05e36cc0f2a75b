"""Drive gains from currents: the estimator against truth, and its sigmas against many draws."""
