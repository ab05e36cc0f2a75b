from .bodies import physics_of as physics_of
