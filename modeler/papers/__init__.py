"""The papers' printed results, beside what is derived."""
