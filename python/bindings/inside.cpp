// weaveform._inside: an analysis in the interpreter's own process. The names that users see are those of
// weaveform/inside.py, which says what each is; here is no more than what it takes to get there.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include "core/version/version.hpp"
#include "errors.hpp"
#include "mesher/resolve/resolve.hpp"
#include "mesher/scene/taken.hpp"
#include "solver/analysis/loading.hpp"
#include "solver/analysis/steered.hpp"
#include "solver/bending/flexure.hpp"
#include "views.hpp"

namespace weaveform::inside {
namespace {

constexpr double degrees = 57.29577951308232;  // of one radian
constexpr int signal_look = 16;                // steps between looks at Ctrl-C

Resolved model_of(const std::string& scene, const std::vector<std::string>& overrides) {
  Findings found;
  const ResolveChecks checks{.of_card = [](const Scene& read, const Card& card) {
    refuse_friction_in_impulses(choose_flexure(card, read), read.analysis.bending_every);
  }};
  Resolved model = resolve(scene, overrides, found, checks);
  found.throw_if_any();
  return model;
}

// A duration by trials is the program's to choose: what a world takes in its place is to be known.
std::string duration_note(const Resolved& model) {
  const auto travels = [](const ToolSpec& tool) { return tool.travel != 0.0; };
  const auto& tools = model.scene.tools;
  const bool asked = leaves_open(model.scene, duration_key) || std::any_of(tools.begin(), tools.end(), travels);
  return asked ? describe_automatic_duration(model) : "";
}

class World {
public:
  World(const std::string& scene, const std::vector<std::string>& overrides, int threads)
      : steered_(model_of(scene, overrides), threads),
        grips_(steered_.world()),
        warnings_(early_warnings(steered_.model())) {
    if (const std::string note = duration_note(steered_.model()); !note.empty()) warnings_.push_back(note);
  }

  // Steps taken: fewer than asked for at the end of the run. Other threads of Python go on meanwhile, but not with this
  // world; Ctrl-C comes through between steps.
  std::int64_t step(std::int64_t wanted) {
    const Turn turn(*this);
    const std::int64_t before = steered_.world().steps();
    for (std::int64_t k = 0; k < wanted && (k == 0 || !steered_.ended()); k += signal_look) {
      {
        const py::gil_scoped_release others_run;
        for (std::int64_t m = k; m < std::min(k + signal_look, wanted) && (m == 0 || !steered_.ended()); ++m)
          steered_.step();
      }
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
    return steered_.world().steps() - before;
  }
  void end() {
    const Turn turn(*this);
    steered_.end();
  }

  Steered& steered() { return steered_; }
  weaveform::World& world() { return steered_.world(); }
  WholeGrips& grips() { return grips_; }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

private:
  // One thread at a time steps.
  struct Turn {
    explicit Turn(World& its) : of(its) {
      if (of.stepping_.exchange(true)) throw std::runtime_error("another thread steps this world; one at a time");
    }
    ~Turn() { of.stepping_ = false; }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    World& of;
  };
  Steered steered_;
  WholeGrips grips_;
  std::vector<std::string> warnings_;
  std::atomic<bool> stepping_ = false;
};

// One ply of a world. Whoever makes it says that it keeps its world (py::keep_alive): views of a ply keep both.
struct Layer {
  World& world;
  std::size_t number;

  [[nodiscard]] Ply& ply() const { return world.world().ply(number); }
  // Where the ply's nodes, yarn elements and cells begin in those of the whole stack; null of a scene of one ply.
  [[nodiscard]] const MeshPly* in_stack() const {
    const auto& plies = world.steered().model().mesh.ply;
    return plies.empty() ? nullptr : &plies[number];
  }
};

py::tuple components(const py::object& self, Components& of, Access access) {
  py::tuple three(3);
  for (std::size_t c = 0; c < 3; ++c) three[c] = view(of[c].data(), of[c].size(), self, access);
  return three;
}

py::dict mesh_of(const Mesh& mesh) {
  py::dict all, sets;
  std::vector<int> family;
  for (const Family one : mesh.yarns.family) family.push_back(1 + static_cast<int>(one));
  for (const NodeSet& set : mesh.sets) sets[py::str(set.name)] = copied(set.node);
  all["start"] = copied(mesh.nodes.position);
  all["crossing"] = copied(mesh.nodes.crossing);
  all["cell_offset"] = copied(mesh.cells.offset);
  all["cell_node"] = copied(mesh.cells.node);
  all["cell_area"] = copied(mesh.cells.area);
  all["yarn_node"] = copied(mesh.yarns.node);
  all["yarn_family"] = copied(family);
  all["yarn_rest_length"] = copied(mesh.yarns.rest_length);
  all["sets"] = sets;
  return all;
}

// (first node, first yarn element, first cell)
py::tuple first_of(const Layer& its) {
  const MeshPly* ply = its.in_stack();
  return ply == nullptr ? py::make_tuple(0, 0, 0) : py::make_tuple(ply->first_node, ply->first_yarn, ply->first_cell);
}

// Of a stack: what the ply feels of the others, of its whole.
void add_slip(const Layer& its, py::dict& all) {
  const PlyContact* contact = its.world.world().ply_contact();
  if (contact == nullptr) return;
  PlyContactState state = contact->state_of(static_cast<int>(its.number));
  if (its.ply().part() != nullptr) state = unfolded(state, *its.ply().part());
  std::vector<int> friction;
  for (const FrictionState one : state.friction) friction.push_back(static_cast<int>(one));
  all["slip_mm"] = copied(state.slip);
  all["slip_path_mm"] = copied(state.slip_path);
  all["ply_pressure_MPa"] = copied(state.pressure);
  all["other_ply"] = copied(state.other);
  all["ply_friction_state"] = copied(friction);
}

py::dict fields_of(const Layer& its) {
  const Ply& ply = its.ply();
  const Fields fields =
      compute_fields(ply.whole(), ply.card(), ply.model(), its.world.world().time(), ply.whole_positions());
  std::vector<double> angle = fields.shear_angle;
  for (double& one : angle) one *= degrees;
  py::dict all;
  all["shear_angle_deg"] = copied(angle);
  all["warp_direction"] = copied(fields.warp);
  all["weft_direction"] = copied(fields.weft);
  all["thickness_mm"] = copied(fields.thickness);
  all["areal_weight_ratio"] = copied(fields.areal_weight);
  all["folded"] = copied(fields.folded);
  all["yarn_strain"] = copied(fields.yarn_strain);
  all["yarn_force_N"] = copied(fields.yarn_force);
  add_slip(its, all);
  return all;
}

py::dict energies_of(World& its) {
  const EnergyBalance& balance = its.world().balance();
  py::dict all;
  all["kinetic"] = balance.kinetic;
  all["damping"] = balance.damping;
  all["external"] = balance.external;
  all["internal"] = balance.internal;
  all["bending"] = balance.bending;
  all["hourglass"] = balance.hourglass;
  return all;
}

// (name, displacement, force); of one that holds several plies the force on all of them
py::list grips_of(World& its) {
  const std::vector<double>& force = its.grips().forces(its.world());
  const std::vector<double>& displacement = its.grips().displacements(its.world());
  py::list all;
  for (std::size_t g = 0; g < force.size(); ++g)
    all.append(py::make_tuple(its.grips().grips()[g].name, displacement[g], force[g]));
  return all;
}

// (lower ply's name, upper ply's name, values in the order of inside.Pair)
py::list pairs_of(World& its) {
  const auto& plies = its.steered().model().mesh.ply;
  py::list all;
  for (const PairReading& is : whole_pairs(its.world()))
    all.append(py::make_tuple(plies[is.lower].name, plies[is.upper].name, is.area, is.force, is.friction_force,
                              is.depth, is.pressure, is.greatest_slip, is.mean_slip, is.stored, is.friction_work));
  return all;
}

// (name, displacement, force, area, the force's components)
py::list tools_of(World& its) {
  py::list all;
  const RigidTools* tools = its.world().tools();
  for (std::size_t t = 0; tools != nullptr && t < tools->readings().size(); ++t) {
    const ToolReading& is = tools->readings()[t];
    all.append(py::make_tuple(its.steered().model().tools[t].name, is.displacement, is.force, is.area, is.whole_force));
  }
  return all;
}

// (columns, rows), those rows whose forces are known
py::tuple history_of(World& its) {
  const History& history = its.steered().history();
  const std::size_t rows = its.steered().closed_rows();
  py::array_t<double> values({rows, history.column.size()});
  for (std::size_t k = 0; k < rows; ++k)
    std::memcpy(values.mutable_data(static_cast<py::ssize_t>(k), 0), history.row[k].data(),
                history.column.size() * sizeof(double));
  return py::make_tuple(history.column, values);
}

// Per node that is solved: its number in the ply's whole.
std::vector<int> whole_nodes(const Ply& ply) {
  std::vector<int> whole(static_cast<std::size_t>(ply.mesh().node_count()));
  for (std::size_t n = 0; n < whole.size(); ++n)
    whole[n] = ply.mesh().shown_node(static_cast<int>(n)) - ply.mesh().first_shown;
  return whole;
}

void add_layer(const py::module_& module) {
  // what is a view of the world's memory keeps it
  const auto state = [](const py::object& self) -> State& { return self.cast<Layer&>().ply().state(); };
  py::class_<Layer> layer(module, "Layer");
  layer.def_property_readonly(
      "position", [state](const py::object& self) { return components(self, state(self).position, Access::write); });
  layer.def_property_readonly(
      "velocity", [state](const py::object& self) { return components(self, state(self).velocity, Access::write); });
  layer.def_property_readonly(
      "force", [state](const py::object& self) { return components(self, state(self).force, Access::read); });
  layer.def_property_readonly("mass", [](const py::object& self) {
    const auto& mass = self.cast<Layer&>().ply().packed().mass;
    return view(const_cast<double*>(mass.data()), mass.size(), self, Access::read);
  });
  layer.def_property_readonly("order", [](const py::object& self) {
    const auto& order = self.cast<Layer&>().ply().packed().packed_of_mesh;
    return view(order.data(), order.size(), self);
  });
  layer.def_property_readonly("external", [](const py::object& self) {
    Layer& its = self.cast<Layer&>();
    return view(its.world.steered().load(its.number), self);
  });
  layer.def_property_readonly(
      "name", [](const Layer& its) { return its.in_stack() == nullptr ? std::string() : its.in_stack()->name; });
  layer.def_property_readonly("first", &first_of);
  layer.def_property_readonly("whole_node", [](const Layer& its) { return copied(whole_nodes(its.ply())); });
  layer.def("positions", [](const Layer& its) { return copied(its.ply().whole_positions()); });
  layer.def("fields", &fields_of);
  layer.def("mesh", [](const Layer& its) { return mesh_of(its.ply().whole()); });
}

}  // namespace
}  // namespace weaveform::inside

PYBIND11_MODULE(_inside, module) {
  namespace py = pybind11;
  using weaveform::inside::Layer;
  using weaveform::inside::World;
  weaveform::inside::pass_errors_on();
  module.attr("version") = weaveform::version_line();
  weaveform::inside::add_layer(module);
  py::class_<World> world(module, "World");
  world.def(py::init<const std::string&, const std::vector<std::string>&, int>());
  world.def("step", &World::step);
  world.def("end", &World::end);
  world.def_property_readonly("time", [](World& its) { return its.world().time(); });
  world.def_property_readonly("duration", [](World& its) { return its.world().duration(); });
  world.def_property_readonly("steps", [](World& its) { return its.world().steps(); });
  world.def_property_readonly("step_size", [](World& its) { return its.world().step(); });
  world.def_property_readonly("step_set_by", [](World& its) { return its.world().stable_step().set_by; });
  world.def_property_readonly("ended", [](World& its) { return its.steered().ended(); });
  world.def_property_readonly("finished", [](World& its) { return its.world().finished(); });
  world.def_property_readonly("parts", [](World& its) { return its.world().parts(); });
  world.def_property_readonly("warnings", &World::warnings);
  world.def("energies", &weaveform::inside::energies_of);
  world.def_property_readonly("plies", [](World& its) { return its.world().size(); });
  world.def(
      "ply",
      [](World& its, std::size_t number) {
        return Layer{its, number};
      },
      py::keep_alive<0, 1>());
  world.def("grips", &weaveform::inside::grips_of);
  world.def("pairs", &weaveform::inside::pairs_of);
  world.def("tools", &weaveform::inside::tools_of);
  world.def("history", &weaveform::inside::history_of);
}
