"""The fast journey: a train as a point or strip of mass, without slip, compiled."""
