"""Which physical effect a model lacks, what it would gain, and the model with it."""
