# A bias extension steered from inside: stopped by its middle's shear angle, then loaded by hand. Cells (# %%) are a
# notebook's. It wants the compiled module: `./dev python` builds it and says how this script is then run; some seconds.

# %% A world instead of a run; the whole blank, for the load will not be symmetric
from pathlib import Path

import numpy as np

from weaveform import inside

scene = Path(__file__).parents[1] / "bias_extension_pw.toml"
world = inside.World(scene, {"blank.coarsening": 3, "model.symmetry": "none"}, threads=1)
ply = world.ply

# %% Own stopping rule: the mean angle of the middle passes 20 deg
middle = np.linalg.norm(ply.cell_centres()[:, :2], axis=1) < 20.0  # mm from the blank's centre


def angle():
    return np.average(np.abs(ply.fields()["shear_angle_deg"][middle]), weights=ply.cell_area[middle])


stopped = world.run(until=lambda world: angle() > 20.0, every=20)
pull = world.grips["top"]
print(f"middle at {angle():.1f} deg after {pull.displacement:.1f} mm, step {world.steps}, {pull.force:.1f} N")

# %% Own load: a force to the right on the middle's nodes, brought up over 2000 steps of the pull that goes on
nodes = np.flatnonzero(np.linalg.norm(ply.start[:, :2], axis=1) < 20.0)  # all are solved, so that numbers are mesh.vtu's
load = ply.external  # N; a view: what is written there acts in the next step
before = ply.positions()
for part in np.linspace(0.0, 1.0, 200):
    load[nodes, 0] = 2.0 * part / len(nodes)
    world.step(10)
moved = (ply.positions() - before)[nodes, 0].mean()
print(f"2 N moved {len(nodes)} nodes by {moved:.2f} mm to the right")

# %% The history up to here, as a run would have written it
world.end()
print(world.history["center.shear_angle_deg"][-1], "deg in the last row")
