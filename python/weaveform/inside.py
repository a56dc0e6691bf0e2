"""Steering an analysis from inside: a world in Python's own process, stepped by Python, with views of its arrays.

    from weaveform import inside
    world = inside.World("examples/bias_extension_pw.toml", {"blank.coarsening": 4})
    while world.step():
        if world.ply.fields()["shear_angle_deg"].max() > 20:
            break

For an own stopping rule or an own load; whoever only wants results calls weaveform.run. The steps are the program's,
bit for bit, as long as nothing is changed from outside. It writes no files.

Wants the compiled module weaveform._inside, which `./dev python` builds. docs/python.md, "Steering from inside", is the
manual. Units: mm, s, N, mJ, tonne; angles in degrees.
"""

from collections import namedtuple
from functools import cached_property
from os import fspath

import numpy as np

from .overrides import set_arguments
from .table import Table

try:
    from . import _inside
except ImportError as error:
    raise ImportError(
        f"weaveform.inside wants the compiled module weaveform._inside ({error}); build it by ./dev python and take the"
        " package from where that says"
    ) from error

Grip = namedtuple("Grip", "displacement force")
Grip.__doc__ = """mm along the grip's motion, and N, the grip's force on the whole fabric along it; of one moment."""
Tool = namedtuple("Tool", "displacement force area force_xyz")
Tool.__doc__ = """mm, N along the tool's motion (of one at rest: its axis), mm2 in contact, and N as x, y, z: of the tool
on the whole fabric, instruments of one moment."""
Pair = namedtuple("Pair", "area force friction_force depth pressure slip mean_slip stored_energy friction_work")
Pair.__doc__ = """Of two plies of a stack: mm2 that touch; N, the sums of the normal forces and of the sizes of the
tangential ones; mm, how deep the faces overlap at most; MPa, the greatest pressure; mm, the longest slip path so far and
the mean over what touches; mJ, stored now and lost to friction so far."""


class Vectors:
    """One vector at each node, as the solver keeps them: x, y and z are three arrays, each a view of its memory.

    They are in the solver's order, in which nodes lie row by row with gaps between: mesh node n is at order[n]. So
    `position.z[ply.order[nodes]] += 0.1` moves nodes; what stands in the gaps means nothing. Made into one array
    (`np.array(position)`, `position.at(nodes)`) they are copies, (nodes, 3), in the mesh's order."""

    def __init__(self, components, order):
        self.x, self.y, self.z = components
        self.order = order

    def __iter__(self):
        return iter((self.x, self.y, self.z))

    def __getitem__(self, component):
        return (self.x, self.y, self.z)[component]

    def __len__(self):
        return 3

    def at(self, nodes=slice(None)):
        """A copy of the vectors at mesh nodes, all of them when none are named: (nodes, 3)."""
        where = self.order[nodes]
        return np.stack([component[where] for component in self], axis=-1)

    def put(self, nodes, values):
        """Sets the vectors at mesh nodes; ValueError where they are for reading only (forces)."""
        values = np.broadcast_to(values, (len(self.order[nodes]), 3))
        for k, component in enumerate(self):
            component[self.order[nodes]] = values[:, k]

    def __array__(self, dtype=None, copy=None):
        if copy is False:
            raise ValueError("three views are one array only as a copy; take x, y or z")
        return np.asarray(self.at(), dtype)


class Ply:
    """A layer of fabric. What is solved may be a half or quarter of the blank (World.parts): position, velocity, force,
    mass, external and order are of the nodes that are solved; positions, fields, cells and yarns of the whole blank, in
    the order of mesh.vtu and of the frames, where those of a stack's plies stand one after another (first_node)."""

    def __init__(self, layer):
        self._layer = layer  # of _inside, and holds on to its world; so do the views

    @property
    def name(self):
        """Of a stack's ply, as the scene has it; "" of a scene of one."""
        return self._layer.name

    @property
    def first_node(self):
        """The number in mesh.vtu of the ply's first node; 0 of a scene of one ply. Numbers here begin at 0 in each."""
        return self._layer.first[0]

    @property
    def first_yarn(self):
        """Of its first yarn element, likewise."""
        return self._layer.first[1]

    @property
    def first_cell(self):
        """Of its first cell, likewise, counted among cells."""
        return self._layer.first[2]

    # views, no copies

    @cached_property
    def order(self):
        """(nodes,): where each mesh node that is solved stands in the arrays of position, velocity, force and mass."""
        return self._layer.order

    @property
    def position(self):
        """Vectors, mm. What is set between steps counts in the next one; held and tied nodes go where they belong."""
        return Vectors(self._layer.position, self.order)

    @property
    def velocity(self):
        """Vectors, mm/s; half a step behind position. May be set likewise."""
        return Vectors(self._layer.velocity, self.order)

    @property
    def force(self):
        """Vectors, N; all that acted on each node, but grips, at the beginning of the last step. Read only."""
        return Vectors(self._layer.force, self.order)

    @property
    def mass(self):
        """In the solver's order, tonne; as the motion has it: that of tied nodes is with the nodes they follow. Read
        only; where `order` does not point it means nothing."""
        return self._layer.mass

    @property
    def external(self):
        """(nodes, 3), N, in the order of the mesh nodes that are solved: forces of your own, which act until they are
        changed. Nothing is added to the analysis as long as nobody asks for it. Their work counts as external work."""
        return self._layer.external

    # of what is solved, and of the whole

    @cached_property
    def whole_node(self):
        """(nodes,): the number in the whole ply of each mesh node that is solved, from 0 in each ply."""
        return self._layer.whole_node

    def positions(self):
        """(nodes of the whole, 3), mm; a copy."""
        return self._layer.positions()

    def fields(self):
        """What a frame shows, computed now by the solver's own functions, by the names that frames have. Of the cells:
        shear_angle_deg, warp_direction, weft_direction, thickness_mm, areal_weight_ratio, folded; of the yarn elements:
        yarn_strain, yarn_force_N; of the nodes of a stack's ply: slip_mm, slip_path_mm, ply_pressure_MPa, other_ply,
        ply_friction_state, as the last forces had them."""
        return self._layer.fields()

    @cached_property
    def _mesh(self):
        return self._layer.mesh()

    @property
    def start(self):
        """(nodes of the whole, 3), mm; where the analysis starts."""
        return self._mesh["start"]

    @property
    def crossing(self):
        """(nodes of the whole, 2): (i, j), counted along warp and weft; -1, -1 of a yarn's end."""
        return self._mesh["crossing"]

    @cached_property
    def cells(self):
        """(cells, most nodes of one), nodes of the whole; -1 beyond those of a cell with fewer."""
        begin, node = self._mesh["cell_offset"], self._mesh["cell_node"]
        count = np.diff(begin)
        cells = np.full((len(count), count.max(initial=0)), -1)
        for k in range(cells.shape[1]):
            cells[count > k, k] = node[begin[:-1][count > k] + k]
        return cells

    @property
    def cell_area(self):
        """(cells,), mm2; flat."""
        return self._mesh["cell_area"]

    def cell_centres(self, positions=None):
        """(cells, 3), mm: the mean of each cell's nodes, at the start or at `positions`."""
        points = self.start if positions is None else np.asarray(positions)
        inside = self.cells >= 0
        return (points[self.cells] * inside[:, :, None]).sum(axis=1) / inside.sum(axis=1)[:, None]

    @property
    def yarns(self):
        """(yarn elements, 2), nodes of the whole."""
        return self._mesh["yarn_node"]

    @property
    def yarn_family(self):
        """(yarn elements,): 1 warp, 2 weft."""
        return self._mesh["yarn_family"]

    @property
    def yarn_rest_length(self):
        """(yarn elements,), mm."""
        return self._mesh["yarn_rest_length"]

    @property
    def sets(self):
        """Nodes of the whole by name: those of each grip, and "outline"."""
        return self._mesh["sets"]


class Plies(tuple):
    """The plies, from the lowest up: by number, or by name."""

    def __getitem__(self, which):
        if not isinstance(which, str):
            return super().__getitem__(which)
        for ply in self:
            if ply.name == which:
                return ply
        raise KeyError(f"no ply {which!r}; there are {[ply.name for ply in self]}")


class World:
    """An analysis from its scene, before its first step. `scene` is a file, `overrides` as weaveform.run takes them,
    `threads` as many as the program would choose unless given; the results hang on neither threads nor views.

    Raises InputError, FileError (weaveform.errors) as the program would, all mistakes at once."""

    def __init__(self, scene, overrides=None, *, threads=0):
        values = [argument[len("--set=") :] for argument in set_arguments(overrides)]
        self._world = _inside.World(fspath(scene), values, int(threads or 0))
        self.plies = Plies(Ply(self._world.ply(k)) for k in range(self._world.plies))

    @property
    def ply(self):
        """The one ply of a scene without [[ply]]; of a stack say which, as plies[0] or plies["NAME"]."""
        if len(self.plies) > 1:
            raise ValueError(f"the scene is a stack of {[ply.name for ply in self.plies]}; take one of world.plies")
        return self.plies[0]

    def step(self, n=1):
        """Takes n steps; how many were taken, which is fewer at the end of the run and 0 after it. Forces are computed
        as a step begins, so that all that was changed before counts in it. Ctrl-C comes through between steps. Other
        threads of Python run meanwhile. Raises PhysicsError when the analysis breaks down, and then at every call."""
        if n < 0:
            raise ValueError(f"step({n}): give a number of steps, 0 or more")
        return 0 if self.ended else self._world.step(n)

    def run(self, until=None, every=1):
        """Steps to the end, or until `until(world)` is true; it is asked after every `every` steps. Whether it was."""
        if every < 1:
            raise ValueError(f"every={every}: give a number of steps, 1 or more")
        while self.step(every):
            if until is not None and until(self):
                return True
        return False

    def end(self):
        """Ends the run where it stands: no further steps, and history holds all rows up to here."""
        self._world.end()

    @property
    def time(self):
        """s; the positions' own."""
        return self._world.time

    @property
    def duration(self):
        """s; of the whole run."""
        return self._world.duration

    @property
    def steps(self):
        """Taken so far."""
        return self._world.steps

    @property
    def step_size(self):
        """s; of the next step, of the last one at the end; 0 before the first, which begins by finding it."""
        return self._world.step_size

    @property
    def step_set_by(self):
        """What limits the stable step, in words; "" before the first."""
        return self._world.step_set_by

    @property
    def finished(self):
        """Whether the run came to its duration."""
        return self._world.finished

    @property
    def ended(self):
        """Whether there are no further steps: finished, or after end()."""
        return self._world.ended

    @property
    def parts(self):
        """The whole is this many times what is solved: 1, 2 or 4. {"model.symmetry": "none"} makes it 1."""
        return self._world.parts

    @property
    def warnings(self):
        """What the program would warn of before the run."""
        return self._world.warnings

    @property
    def history(self):
        """A weaveform.Table with the columns of history.csv. Its forces are means over half a row before and after, so
        the last row so far is missing until they are known; end() closes it."""
        return Table.of("history", *self._world.history())

    @property
    def energies(self):
        """mJ, of the whole, by name: kinetic, damping (lost so far) and external (work put in so far) at the beginning
        of the last step; internal, and bending and hourglass as parts of it, at the last row of history, which alone
        asks for them."""
        return self._world.energies()

    @property
    def grips(self):
        """Grip(displacement, force) by name, at the beginning of the last step: the momentary force, where history has
        means. 0 before the first step."""
        return {name: Grip(*values) for name, *values in self._world.grips()}

    @property
    def pairs(self):
        """Pair(area, force, ...) by "LOWER/UPPER", of every two plies of a stack, at the beginning of the last step; 0
        of those that have not touched."""
        return {f"{lower}/{upper}": Pair(*values) for lower, upper, *values in self._world.pairs()}

    @property
    def tools(self):
        """Tool(displacement, force, area, force_xyz) by name, likewise; empty without tools."""
        return {name: Tool(*values[:3], np.array(values[3])) for name, *values in self._world.tools()}

    def __repr__(self):
        return f"<World at {self.time:.4g} s of {self.duration:.4g} s, step {self.steps}>"
