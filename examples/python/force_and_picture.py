# A bias extension from Python: run it, look at it, draw its force. Cells (# %%) are a notebook's, in Jupyter by jupytext,
# VS Code or Spyder; `python3 examples/python/force_and_picture.py` runs them all, in seconds, with or without a screen.
# The program and the package are found as docs/python.md says. Pictures go to results/python.

# %% Run a scene, coarser than it stands there
from pathlib import Path

import weaveform as wf

scene = Path(__file__).parents[1] / "bias_extension_pw.toml"
result = wf.run(scene, {"blank.coarsening": 3}, output="results/python")

# %% A picture of the last frame
result.frames[-1].picture(result.path / "shear_angle.png", "absolute_shear_angle_deg")

# %% The force curve
result.history.chart("top.displacement_mm", "top.force_N", result.path / "force.png")

# %% Numbers are NumPy arrays
force, travel = result.history["top.force_N"], result.history["top.displacement_mm"]
angle = result.frames[-1].cells["absolute_shear_angle_deg"]
print(f"{force[-1]:.1f} N after {travel[-1]:.0f} mm; greatest shear angle {angle.max():.1f} deg")
