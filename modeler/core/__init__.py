"""Nouns and tools that every stage shares; imports nothing of the other stages."""
