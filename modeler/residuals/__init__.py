"""What a residual may be, from plain arrays: predictable, repeated, lasting, in bursts, rippling."""
