"""What a residual may be, from plain arrays: predictable, repeated, lasting, bursts, ripple."""
