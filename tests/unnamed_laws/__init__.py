"""Machines with a law of joint torque that no catalogue holds, and what its true form explains."""
