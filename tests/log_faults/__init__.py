"""Simulated logs with one fault each, put in by numpy: is it told, and nothing else with it?"""
