"""How fast modeler is, side by side with peers in one run: `python -m benchmarks --json FILE`."""
