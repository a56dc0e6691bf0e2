"""Steering from inside: the module's steps are the program's, its arrays are the solver's own, and what is done to them
counts. inside.sh builds the module; where it is not, there is nothing to test."""

import gc
import os
import pickle
import re
import runpy
import subprocess
import sys
import threading

import numpy as np
import pytest

import weaveform as wf
from conftest import repository, small

if "WEAVEFORM_INSIDE_BUILT" not in os.environ:
    pytest.importorskip("weaveform.inside")
from weaveform import inside  # noqa: E402

whole = {**small, "model.symmetry": "none"}


@pytest.fixture
def world(examples):
    return inside.World(examples / "bias_extension_pw.toml", small, threads=1)


@pytest.fixture
def whole_world(examples):
    return inside.World(examples / "bias_extension_pw.toml", whole, threads=1)


def as_written(values):
    return np.array([float(f"{value:.10g}") for value in values])


def assert_same_run(world, result):
    """Every row of history as it is written, and every bit of the last positions."""
    history = world.history
    assert history.columns == result.history.columns and history.rows == result.history.rows
    for name in history.columns:
        assert np.array_equal(as_written(history[name]), as_written(result.history[name])), name
    assert np.array_equal(world.ply.positions(), result.frames[-1].positions)


def test_a_world_stepped_to_its_end_is_the_programs_run(world, bias):
    assert not world.finished and world.time == 0.0
    while world.step(7):
        pass
    assert world.finished and world.ended and world.time == world.duration
    assert world.steps == bias.statistics["steps"]
    assert_same_run(world, bias)


def test_tools_and_threads_change_no_bit(examples, hemisphere):
    overrides = {"blank.coarsening": 16, "output.frames": 6}
    world = inside.World(examples / "hemisphere_pw_fast.toml", overrides, threads=2)
    assert not world.run()
    assert_same_run(world, hemisphere)
    assert set(world.tools) == set(hemisphere.frames[-1].tool_numbers)
    punch = world.tools["punch"]
    assert punch.displacement == pytest.approx(hemisphere.history["punch.displacement_mm"][-1], rel=1e-8)
    assert punch.force == pytest.approx(punch.force_xyz @ [0, 0, np.sign(punch.force_xyz[2] * punch.force)])


@pytest.mark.parametrize(
    ("scene", "overrides"),
    [
        ("shear_frame_pw.toml", {"blank.coarsening": 4}),  # ties, and a mechanism for a grip
        ("cantilever_pw.toml", {"blank.coarsening": 1.5}),  # weight and bending
        ("bias_extension_pw.toml", {**small, "analysis.perturbation": 0.01, "analysis.mass_scale": 3.0}),
    ],
)
def test_other_scenes_are_the_programs_runs_too(examples, tmp_path, scene, overrides):
    overrides = {**overrides, "analysis.duration": 0.01, "output.frames": 1}
    result = wf.run(examples / scene, overrides, output=tmp_path / "out", progress=False)
    world = inside.World(examples / scene, overrides)
    world.run(every=100)
    assert_same_run(world, result)


def test_a_world_that_ends_before_it_begins_has_no_history(world):
    world.end()
    assert world.ended and not world.finished and world.history.rows == 0 and world.step() == 0


def test_a_load_that_is_nothing_changes_no_bit(world, bias):
    assert not world.ply.external.any()
    world.run()
    assert_same_run(world, bias)


def test_looking_changes_no_bit(world, bias):
    while world.step(50):
        world.ply.fields(), world.ply.positions(), world.energies, world.grips, world.history, world.ply.mass
    assert_same_run(world, bias)


def test_fields_are_the_frames(world, bias):
    world.run()
    frame = bias.frames[-1]
    fields = world.ply.fields()
    for name in ("shear_angle_deg", "thickness_mm", "areal_weight_ratio", "warp_direction"):
        assert np.allclose(fields[name], frame.cells[name], rtol=1e-6, atol=1e-6), name
    for name in ("yarn_strain", "yarn_force_N"):
        assert np.allclose(fields[name], frame.yarns[name], rtol=1e-6, atol=1e-6), name
    assert np.array_equal(fields["folded"], frame.cells["folded"].astype(bool))
    assert np.array_equal(world.ply.cells, frame.cells.nodes)
    assert np.array_equal(world.ply.yarns, frame.yarns.nodes)
    assert np.array_equal(world.ply.yarn_family, frame.yarns["family"])


def test_views_are_the_solvers_memory(whole_world):
    ply = whole_world.ply
    arrays = [*ply.position, *ply.velocity, *ply.force, ply.mass, ply.order, ply.external]
    for one, again in zip(arrays, [*ply.position, *ply.velocity, *ply.force, ply.mass, ply.order, ply.external]):
        assert not one.flags.owndata and np.shares_memory(one, again)
    places = [array.__array_interface__["data"][0] for array in arrays]
    y = ply.position.y
    before = y.copy()
    whole_world.step(200)
    assert not np.array_equal(y, before), "a view shows what step() did"
    assert places == [array.__array_interface__["data"][0] for array in arrays]
    whole_world.run()
    assert np.shares_memory(y, ply.position.y), "also after the last step"
    assert np.array_equal(y[ply.order], ply.positions()[:, 1])
    assert np.array_equal(np.array(ply.position), ply.positions())


def test_the_order_maps_nodes_of_a_part_to_the_whole(world, whole_world):
    assert (world.parts, whole_world.parts) == (2, 1)
    world.step(100)
    whole_world.step(100)
    part, all_of_it = world.ply, whole_world.ply
    there = part.whole_node >= 0
    nodes = part.whole_node[there]
    assert 0.4 < len(nodes) / len(all_of_it.order) < 0.8
    assert np.array_equal(all_of_it.whole_node, np.arange(len(all_of_it.order)))
    assert np.allclose(part.position.at(there), part.positions()[nodes], rtol=0, atol=1e-9)
    assert np.allclose(part.position.at(there), all_of_it.position.at(nodes), rtol=0, atol=1e-6)
    own = part.mass[part.order] > 0  # images of nodes beyond a plane, and tied nodes, have none
    assert own.any() and not own.all()


def test_a_view_outlives_the_names_of_its_world(examples):
    world = inside.World(examples / "bias_extension_pw.toml", small)
    world.step(20)
    x, load = world.ply.position.x, world.ply.external
    seen = x.copy()
    del world
    gc.collect()
    filler = [np.full(len(x), 7.0) for _ in range(200)]  # what would be written where the state was
    assert np.array_equal(x, seen) and not load.any() and len(filler) == 200


def test_forces_and_masses_are_for_reading(world):
    for array in (*world.ply.force, world.ply.mass, world.ply.order):
        with pytest.raises(ValueError):
            array[0] = 1


def test_an_own_rule_stops_where_it_says(world, bias):
    def angle():
        return np.abs(world.ply.fields()["shear_angle_deg"]).max()

    assert world.run(until=lambda its: its is world and angle() > 5.0, every=10)
    assert 5.0 < angle() < 6.0 and not world.finished and not world.ended
    rows = world.history.rows
    world.end()
    assert world.ended and world.step() == 0 and rows <= world.history.rows <= rows + 1
    table = world.history
    for name in ("top.force_N", "top.displacement_mm"):  # what is known is what the whole run has
        assert np.array_equal(as_written(table[name][:rows]), as_written(bias.history[name][:rows]))


def test_an_own_load_adds_the_energy_of_its_work(examples):
    """A ply that nothing else moves: force times way is what internal, kinetic and lost energies are made of."""
    still = {**whole, "grip.top.travel": 0.0, "output.history": 50}
    world = inside.World(examples / "bias_extension_pw.toml", still)
    ply = world.ply
    nodes = np.flatnonzero(np.linalg.norm(ply.start[:, :2], axis=1) < 20.0)
    work, way_before, force_before = 0.0, ply.position.at(nodes)[:, 0], 0.0
    while not world.ended:
        force = 3.0 * min(1.0, world.time / (0.3 * world.duration)) / len(nodes)
        ply.external[nodes, 0] = force
        way = ply.position.at(nodes)[:, 0]
        work += 0.5 * (force_before + force) * (way - way_before).sum()
        way_before, force_before = way, force
        world.step()
    work += force * (ply.position.at(nodes)[:, 0] - way_before).sum()  # the last step's way
    assert work > 1e-3
    energies = world.energies
    assert energies["external"] == pytest.approx(work, rel=1e-9)
    sum_of = energies["internal"] + energies["kinetic"] + energies["damping"]
    assert sum_of == pytest.approx(energies["external"], rel=1e-4)
    assert abs(world.history["energy_error"][-1]) < 0.02
    assert (way_before > ply.start[nodes, 0]).all()


def test_a_force_on_a_part_is_that_force_on_every_image(world, whole_world):
    """Upwards on every node: that of a node in the mirror plane is set to half there, where half of its mass is."""
    share = np.ones(len(world.ply.order))
    mass = np.full(len(whole_world.ply.order), np.nan)
    mass[:] = whole_world.ply.mass[whole_world.ply.order]
    there = world.ply.whole_node >= 0
    own = world.ply.mass[world.ply.order]
    share[there] = np.clip(own[there] / np.maximum(mass[world.ply.whole_node[there]], 1e-30), 0, 1).round(2)
    share[own == 0] = 0
    for its, shares in ((world, share), (whole_world, (mass > 0).astype(float))):
        its.ply.external[:, 2] = 1e-4 * shares
        while its.time < 0.02 * its.duration:
            its.step()
    assert np.allclose(share * 2, (share * 2).round()), "a whole node or half of one"
    height, of_the_whole = world.ply.positions()[:, 2], whole_world.ply.positions()[:, 2]
    assert of_the_whole.max() > 1e-4
    assert np.allclose(height, of_the_whole, rtol=1e-6, atol=1e-6 * of_the_whole.max())
    assert world.energies["external"] == pytest.approx(whole_world.energies["external"], rel=1e-6)


def test_newton_holds_for_an_own_load(whole_world):
    """In one small step from rest a lone force accelerates its node by itself over its mass."""
    ply = whole_world.ply
    free = int(np.argmin(np.linalg.norm(ply.start[:, :2], axis=1)))
    ply.external[free] = [0.0, 0.0, 1e-3]
    whole_world.step()
    at = ply.order[free]
    assert ply.force.z[at] == 1e-3
    # half a step before, the velocity is that of half a step's kick
    kick = 0.5 * whole_world.time
    assert ply.velocity.z[at] == pytest.approx(kick * 1e-3 / ply.mass[at], rel=1e-3)
    assert whole_world.ply.velocity.at([free])[0, 2] == ply.velocity.z[at]


def test_positions_that_are_set_count_in_the_next_step(whole_world):
    ply = whole_world.ply
    whole_world.step(10)
    free = int(np.argmin(np.linalg.norm(ply.start[:, :2], axis=1)))
    moved = ply.position.at([free]) + [[0.0, 0.0, 0.5]]
    ply.position.put([free], moved)
    whole_world.step()
    assert ply.force.z[ply.order[free]] < 0.0, "stretched yarns pull it back"


def test_a_run_that_breaks_down_says_so_ever_after(examples):
    hasty = {**whole, "grip.top.travel": 100, "analysis.duration": 1e-4}
    world = inside.World(examples / "bias_extension_pw.toml", hasty)
    with pytest.raises(wf.PhysicsError) as caught:
        world.run()
    assert caught.value.code == 3 and "step" in str(caught.value)
    with pytest.raises(wf.PhysicsError, match=re.escape(str(caught.value))):
        world.step()
    assert pickle.loads(pickle.dumps(caught.value)).lines == caught.value.lines


def test_errors_are_those_of_the_package(examples, tmp_path):
    with pytest.raises(wf.InputError) as caught:
        inside.World(examples / "bias_extension_pw.toml", {"blank.coarsning": 2, "analysis.duration": -1})
    assert len(caught.value.lines) == 2 and caught.value.code == 2
    assert "did you mean 'coarsening'" in caught.value.lines[0]
    with pytest.raises(wf.FileError):
        inside.World(tmp_path / "none.toml")
    with pytest.raises(TypeError):
        inside.World(examples / "bias_extension_pw.toml", {"blank.coarsening": None})
    world = inside.World(examples / "bias_extension_pw.toml", small)
    with pytest.raises(ValueError):
        world.step(-1)
    assert world.step(0) == 0 and world.steps == 0


two_plies = {
    "blank.coarsening": 4,
    "tools.punch.travel": 15,
    "analysis.duration": 0.02,
    "output.frames": 2,
    "output.history": 20,
}


@pytest.fixture(scope="session")
def stack(examples, tmp_path_factory):
    """Two plies drawn a little way, a quarter of them solved."""
    folder = tmp_path_factory.mktemp("stack") / "result"
    return wf.run(examples / "hemisphere_two_plies.toml", two_plies, output=folder, progress=False)


def test_a_stack_stepped_to_its_end_is_the_programs_run(examples, stack):
    world = inside.World(examples / "hemisphere_two_plies.toml", two_plies, threads=2)
    world.run(every=50)
    assert world.finished and world.steps == stack.statistics["steps"]
    assert world.history.columns == stack.history.columns
    for name in world.history.columns:
        assert np.array_equal(as_written(world.history[name]), as_written(stack.history[name])), name
    frame = stack.frames[-1]
    assert np.array_equal(np.concatenate([ply.positions() for ply in world.plies]), frame.positions)
    for number, ply in enumerate(world.plies):
        nodes = slice(ply.first_node, ply.first_node + len(ply.start))
        cells = slice(ply.first_cell, ply.first_cell + len(ply.cells))
        yarns = slice(ply.first_yarn, ply.first_yarn + len(ply.yarns))
        assert (frame.points["ply"][nodes] == number).all() and (frame.points["ply"] == number).sum() == len(ply.start)
        fields = ply.fields()
        for name in ("slip_mm", "slip_path_mm", "ply_pressure_MPa", "other_ply", "ply_friction_state"):
            assert np.array_equal(fields[name], frame.points[name][nodes]), name
        assert np.allclose(fields["shear_angle_deg"], frame.cells["shear_angle_deg"][cells], rtol=1e-12, atol=1e-12)
        assert np.allclose(fields["yarn_force_N"], frame.yarns["yarn_force_N"][yarns], rtol=1e-12, atol=1e-12)
        assert np.array_equal(ply.yarns + ply.first_node, frame.yarns.nodes[yarns])
        there = ply.whole_node[ply.whole_node >= 0]
        assert there.max() < len(ply.start), "numbers begin at 0 in each ply"
    pair, row = world.pairs["lower/upper"], {name: values[-1] for name, values in world.history.items()}
    for value, column in (
        (pair.area, "contact_area_mm2"),
        (pair.force, "force_N"),
        (pair.slip, "slip_mm"),
        (pair.mean_slip, "mean_slip_mm"),
        (pair.pressure, "pressure_MPa"),
        (pair.stored_energy, "stored_energy_mJ"),
        (pair.friction_work, "friction_work_mJ"),
    ):
        assert value == pytest.approx(row[f"lower/upper.{column}"], rel=1e-8), column
    assert pair.slip > 0.1 and 0.0 < pair.friction_force <= 0.2 * pair.force * (1 + 1e-9)


def test_plies_have_numbers_and_names(examples):
    world = inside.World(examples / "hemisphere_two_plies.toml", two_plies)
    assert [ply.name for ply in world.plies] == ["lower", "upper"]
    assert world.plies["upper"] is world.plies[1] and world.plies[1].first_node == len(world.plies[0].start)
    with pytest.raises(KeyError, match="lower"):
        world.plies["lowre"]
    with pytest.raises(ValueError, match="world.plies"):
        world.ply.positions()
    x = world.plies["upper"].position.x
    seen = x.copy()
    del world
    gc.collect()
    assert np.array_equal(x, seen), "a view outlives the names of its world"


def test_loads_on_two_plies_go_through_their_pair(tmp_path):
    """Pressed together by the same force, while the upper one is pulled aside: what each feels of the other is equal and
    opposite, the work of all loads is the energy there is."""
    scene = tmp_path / "pressed.toml"
    scene.write_text(
        """
[fabric]
material = "twintex-pw"
[blank]
size = [60.0, 60.0]
coarsening = 2
[model]
symmetry = "none"
[[ply]]
name = "lower"
[[ply]]
name = "upper"
yarn_angle = 45
[stack]
friction = 0.3
[analysis]
duration = 0.01
""",
        "utf-8",
    )
    world = inside.World(scene)
    loads = ((0.0, 2.0), (0.3, -2.0))  # N, aside and up, on the lower and on the upper ply; by their masses
    work, before = 0.0, ()
    while not world.ended:
        for ply, (aside, up) in zip(world.plies, loads):
            mass = ply.mass[ply.order]
            ply.external[:] = min(1.0, world.time / 0.005) * np.outer(mass / mass.sum(), [aside, 0.0, up])
        now = [(ply.position.at(), ply.external.copy()) for ply in world.plies]
        for (x, force), (x_before, force_before) in zip(now, before):
            work += 0.5 * ((force + force_before) * (x - x_before)).sum()
        before = now
        world.step()
    for ply, (x, force) in zip(world.plies, before):  # the last step's way
        work += (force * (ply.position.at() - x)).sum()
    assert world.energies["external"] == pytest.approx(work, rel=1e-9) and work > 1e-3
    assert abs(world.history["energy_error"][-1]) < 0.02
    felt = []
    for ply in world.plies:  # of the other; the ply's own forces sum to nothing, and those of tied nodes are given on
        own = ply.mass[ply.order] > 0
        felt.append((ply.force.at()[own] - ply.external[own]).sum(axis=0))
    pair = world.pairs["lower/upper"]
    assert np.allclose(felt[0], -felt[1], rtol=0, atol=1e-9 * pair.force)
    assert -felt[0][2] == pytest.approx(pair.force, rel=0.05)
    assert 0.0 < felt[0][0] <= 0.3 * pair.force, "it is dragged along"


def test_an_exception_of_the_rule_comes_through_and_the_world_goes_on(world, bias):
    class Enough(Exception):
        pass

    def rule(_):
        raise Enough

    with pytest.raises(Enough):
        world.run(until=rule, every=100)
    assert world.steps == 100
    world.run()
    assert_same_run(world, bias)


def test_ctrl_c_comes_through_between_steps(examples):
    code = (
        "import os, signal, threading, sys\n"
        "from weaveform import inside\n"
        "world = inside.World(sys.argv[1], {'blank.coarsening': 2, 'analysis.duration': 5.0})\n"
        "threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()\n"
        "try:\n    world.step(10**9)\nexcept KeyboardInterrupt:\n    before = world.steps\n"
        "    print(before > 0, world.step(3), world.steps - before)\n"
    )
    scene = str(examples / "bias_extension_pw.toml")
    done = subprocess.run([sys.executable, "-c", code, scene], capture_output=True, text=True, timeout=120)
    assert done.stdout.split() == ["True", "3", "3"], done.stderr


def test_one_thread_at_a_time_steps(examples):
    world = inside.World(examples / "bias_extension_pw.toml", {**small, "blank.coarsening": 2})
    other = threading.Thread(target=world.step, args=(3000,))
    other.start()
    refused = 0
    while other.is_alive() and not refused:
        try:
            world.step()
        except RuntimeError as error:
            assert "one at a time" in str(error)
            refused += 1
    other.join()
    assert refused or world.steps >= 3000


def test_the_documents_blocks_run(examples, tmp_path, monkeypatch):
    text = (repository / "docs" / "python.md").read_text("utf-8")
    section = text[text.index("\n## Steering from inside") :]
    section = section[: section.find("\n## ", 4)]
    blocks = re.findall(r"^```python\n(.*?)^```", section, re.M | re.S)
    assert len(blocks) >= 3
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(examples)
    names = {}
    for block in blocks:
        exec(compile(block, "docs/python.md", "exec"), names)


def test_the_example_stops_at_twenty_degrees(capsys):
    runpy.run_path(str(repository / "examples" / "python" / "own_stop.py"))
    said = capsys.readouterr().out
    angle = float(re.search(r"middle at ([\d.]+) deg", said)[1])
    moved = float(re.search(r"by ([\d.]+) mm to the right", said)[1])
    assert 20.0 <= angle < 20.5 and moved > 0.01, said


def test_the_manual_says_every_name():
    text = (repository / "docs" / "python.md").read_text("utf-8")
    names = [name for of in (inside.World, inside.Ply) for name in vars(of) if not name.startswith("_")]
    missing = [name for name in names if not re.search(rf"\b{name}\b", text)]
    assert not missing


def test_a_duration_that_is_left_to_trials_is_said_to_be_another(examples):
    world = inside.World(examples / "hemisphere_pw.toml", {"blank.coarsening": 8})
    said = [line for line in world.warnings if line.startswith("analysis.duration = ")]
    assert len(said) == 1 and "not by trials" in said[0] and f"{world.duration:.3g} s" in said[0]
    given = inside.World(examples / "hemisphere_pw.toml", {"blank.coarsening": 8, "analysis.duration": 0.1})
    assert not any("analysis.duration" in line for line in given.warnings)
