"""What careless and hostile users do, one row each: made from a good input, run, and judged."""
