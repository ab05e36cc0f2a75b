"""How much every hypothesis explains beside a model, on blocks of time that were not fitted."""
