"""The tests of gradhesion.twin, and the scenes that it has solved for the tests of all the rest."""
