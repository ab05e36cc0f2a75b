"""Motions that excite a robot within its limits: what to drive before a fit."""
