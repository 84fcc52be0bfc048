"""The reference problems as solve_bvp takes them.

All but E21, whose condition inside the interval solve_bvp does not take. Names are those of the
crate `reference-problems`, where the statements are explained.
"""

from fluid_flow import fluid_flow
from layers import linear_layers, multiple_solutions, nonlinear_layers, turning_points
from parameters import eigenvalues, periodic
from special import special_conditions, systems


def all_problems():
    """Every problem, grouped by kind."""
    yield from linear_layers()
    yield from turning_points()
    yield from nonlinear_layers()
    yield from multiple_solutions()
    yield from fluid_flow()
    yield from eigenvalues()
    yield from periodic()
    yield from special_conditions()
    yield from systems()
