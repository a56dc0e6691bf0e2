// Reads and checks fit files; the key table is in fit_schema.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "fabric/identify/fit_schema.hpp"
#include "fabric/identify/unit.hpp"

namespace weaveform::identify {
namespace {

constexpr double same_yarn = 0.01;  // relative, between linear densities: as exact as sections are given

const toml::table* table_at(const toml::table& parent, const std::string& name, const std::string& title,
                            Complaints& complaints) {
  const toml::node* node = parent.get(name);
  if (node == nullptr) return nullptr;
  if (!node->is_table()) complaints.add(*node, fmt::format("'{}' must be a table; begin it with [{}]", name, title));
  return node->as_table();
}

// What the base says for Eq. 11: from it the section follows another linear density.
void keep_densities(const toml::table& card, const std::string& family, YarnFile& yarn) {
  const auto typed = [&](const char* key) {
    const auto own = card["yarn"][family][key].value<double>();
    return own ? own : card["yarn"][key].value<double>();
  };
  const auto fibre = typed("fibre_density"), matrix = typed("matrix_density"), share = typed("fibre_volume_fraction");
  if (!fibre || !matrix || !share) return;
  yarn.fibre_volume_fraction = share;
  yarn.fibre_density = fibre;
  yarn.matrix_density = matrix;
}

void read_base(const toml::table& root, FitSpec& spec, Complaints& complaints) {
  if (spec.head.base.empty()) return;
  try {
    spec.base = load_card(spec.head.base, spec.file);
    spec.has_base = true;
  } catch (const InputError& error) {
    for (const auto& line : error.complaints()) complaints.add(*root.get("base"), line);
  }
  if (!spec.has_base) return;
  spec.bending = spec.base.bending;
  // The base in the words of a card file, so that the keys of the fit file can replace any of them.
  const toml::table card = parse_toml(card_to_toml(spec.base), "base card");
  const toml::table typed = parse_toml(card_text_of(spec.head.base, spec.file), "base card");
  for (std::size_t f = 0; f < yarn_families.size(); ++f) {
    Complaints none("base card");
    read_keys(*card["yarn"][yarn_families[f]].as_table(), "[yarn]", yarn_keys(), spec.yarn[f], none);
    keep_densities(typed, yarn_families[f], spec.yarn[f]);
  }
}

// A section given by the fit file replaces the base card's Eq. 11 and the reverse; another linear density makes a
// section of its own.
void read_yarn_table(const toml::table& table, const std::string& title, YarnFile& yarn, Complaints& complaints) {
  const auto has = [&](const char* name) { return table.contains(name); };
  const bool densities = has("fibre_volume_fraction") || has("fibre_density") || has("matrix_density");
  const double linear_density = yarn.linear_density;
  const bool had_section = yarn.section.has_value();
  if (densities) yarn.section.reset();
  if (has("section")) yarn.fibre_volume_fraction = yarn.fibre_density = yarn.matrix_density = std::nullopt;
  if (has("compression")) yarn.compression_modulus.reset();
  if (has("compression_modulus")) yarn.compression.clear();
  if (has("tension"))
    yarn.linear_modulus = yarn.compression_modulus = yarn.valid_to = yarn.tearing_strain = std::nullopt;
  read_keys(table, title, yarn_keys(), yarn, complaints,
            title == "[yarn]" ? yarn_families : std::vector<std::string>{});
  if (!had_section || !has("linear_density") || has("section") || densities) return;
  if (std::abs(yarn.linear_density / linear_density - 1.0) < same_yarn) return;
  const bool eq11 = yarn.fibre_volume_fraction && yarn.fibre_density && yarn.matrix_density;
  if (eq11)
    yarn.section.reset();
  else
    complaints.add(*table.get("linear_density"),
                   fmt::format("{} has another linear density ({} tex) than the base card ({} tex), whose section {} "
                               "mm^2 goes with that; add 'section' (mm^2), or what Eq. 11 needs",
                               title, yarn.linear_density, linear_density, *yarn.section));
}

// A card with a section of its own needs no densities, which a hand that corrects the section would have to correct
// too.
void drop_unused_densities(const toml::table* common, const toml::table* own, YarnFile& yarn) {
  const auto typed = [&](const char* key) {
    return (common != nullptr && common->contains(key)) || (own != nullptr && own->contains(key));
  };
  if (!yarn.section || typed("fibre_volume_fraction") || typed("fibre_density") || typed("matrix_density")) return;
  yarn.fibre_volume_fraction = yarn.fibre_density = yarn.matrix_density = std::nullopt;
}

void read_yarns(const toml::table& root, FitSpec& spec, Complaints& complaints) {
  const toml::table* common = table_at(root, "yarn", "yarn", complaints);
  for (std::size_t f = 0; f < yarn_families.size(); ++f) {
    YarnFile& yarn = spec.yarn[f];
    const toml::table* own = nullptr;
    if (common != nullptr) {
      read_yarn_table(*common, "[yarn]", yarn, complaints);
      own = table_at(*common, yarn_families[f], "yarn." + yarn_families[f], complaints);
      if (own != nullptr) read_yarn_table(*own, "[yarn." + yarn_families[f] + "]", yarn, complaints);
    }
    drop_unused_densities(common, own, yarn);
    const toml::node& place = common != nullptr ? static_cast<const toml::node&>(*common) : root;
    const auto lacks = [&](const char* key, const char* unit) {
      complaints.add(place, fmt::format("the {} yarn lacks '{}' ({}) and no base card gives it; add it to [yarn] or "
                                        "[yarn.{}], or name a 'base'",
                                        yarn_families[f], key, unit, yarn_families[f]));
    };
    if (!(yarn.linear_density > 0.0)) lacks("linear_density", "tex");
    if (!(yarn.interval > 0.0)) lacks("interval", "mm");
    const bool eq11 = yarn.fibre_volume_fraction && yarn.fibre_density && yarn.matrix_density;
    if (!yarn.section && !eq11) lacks("section", "mm^2, or what Eq. 11 needs");
  }
}

std::vector<TestSpec> read_tests(const toml::table& root, const std::string& name,
                                 const std::vector<Key<TestSpec>>& keys, Complaints& complaints) {
  std::vector<TestSpec> tests;
  const toml::node* node = root.get(name);
  if (node == nullptr) return tests;
  if (!node->is_array_of_tables()) {
    complaints.add(*node, fmt::format("'{0}' is a list of tables; begin each with [[{0}]]", name));
    return tests;
  }
  for (const auto& item : *node->as_array()) {
    TestSpec test;
    read_keys(*item.as_table(), "[[" + name + "]]", keys, test, complaints);
    require_keys(*item.as_table(), "[[" + name + "]]", keys, complaints);
    if (item.as_table()->contains("files") && test.files.empty())
      complaints.add(*item.as_table()->get("files"), "'files' names no file; name at least one");
    for (const auto& [key, factor] : {std::pair("displacement_factor", test.displacement_factor),
                                      {"force_factor", test.force_factor},
                                      {"strain_factor", test.strain_factor},
                                      {"stress_factor", test.stress_factor},
                                      {"angle_factor", test.angle_factor},
                                      {"normalised_force_factor", test.normalised_force_factor},
                                      {"curvature_factor", test.curvature_factor},
                                      {"moment_factor", test.moment_factor},
                                      {"x_factor", test.x_factor},
                                      {"y_factor", test.y_factor}})
      if (factor == 0.0) complaints.add(item, fmt::format("'{}' is 0; it must not be", key));
    tests.push_back(test);
  }
  return tests;
}

// A test gives either the machine's displacement and force, or two derived columns; each complete.
void check_columns(const toml::node& place, const TestSpec& test, const std::string& kind, const std::string& first,
                   const std::string& first_key, const std::string& second, const std::string& second_key,
                   Complaints& complaints) {
  const bool machine = !test.displacement_column.empty() || !test.force_column.empty();
  const bool derived = !first.empty() || !second.empty();
  const auto both = [](const std::string& a, const std::string& b) { return !a.empty() && !b.empty(); };
  if (machine && derived) {
    complaints.add(place, fmt::format("[[{}]] gives both displacement or force and {} or {}; keep one pair", kind,
                                      first_key, second_key));
  } else if (!(both(test.displacement_column, test.force_column) || both(first, second))) {
    const std::string other = first_key.empty() ? "" : fmt::format(", or '{}' and '{}'", first_key, second_key);
    complaints.add(place,
                   fmt::format("[[{}]] lacks columns; give 'displacement_column' and 'force_column'{}", kind, other));
  }
}

void check_tensile(const toml::node& place, const TestSpec& test, Complaints& complaints) {
  check_columns(place, test, "tensile", test.strain_column, "strain_column", test.stress_column, "stress_column",
                complaints);
  if (!test.displacement_column.empty() && !test.gauge_length)
    complaints.add(place, "[[tensile]] with a displacement lacks 'gauge_length' (mm); add it");
  if (test.elastic_range && !((*test.elastic_range)[0] < (*test.elastic_range)[1]))
    complaints.add(place, "'elastic_range' must rise: [from, to]");
}

void check_frame(const toml::node& place, const TestSpec& test, Complaints& complaints) {
  check_columns(place, test, "shear_frame", test.angle_column, "angle_column", test.normalised_force_column,
                "normalised_force_column", complaints);
  if (!test.displacement_column.empty() && !(test.frame_length && test.fabric_length))
    complaints.add(place, "[[shear_frame]] with a displacement lacks 'frame_length' or 'fabric_length' (mm); add both");
  if (test.frame_length && test.fabric_length && *test.fabric_length > *test.frame_length)
    complaints.add(place, fmt::format("'fabric_length' {} mm is greater than 'frame_length' {} mm; exchange them?",
                                      *test.fabric_length, *test.frame_length));
}

void check_bias(const toml::node& place, const TestSpec& test, Complaints& complaints) {
  check_columns(place, test, "bias_extension", "", "", "", "", complaints);
  if (test.width && test.length && *test.length <= *test.width)
    complaints.add(place, fmt::format("'length' {} mm is not greater than 'width' {} mm; exchange them? No zone of the "
                                      "specimen would be free of both grips",
                                      *test.length, *test.width));
}

bool is_unit_of(const std::string& name, Quantity quantity) {
  const auto names = unit_names(quantity);
  return std::find(names.begin(), names.end(), name) != names.end();
}

void check_moment_curvature(const toml::node& place, const TestSpec& test, Complaints& complaints) {
  const bool per_width = is_unit_of(test.moment_unit, Quantity::moment_per_length);
  if (!per_width && !test.specimen_width)
    complaints.add(place, fmt::format("[[moment_curvature]] has moments in '{}', of the whole specimen, but no "
                                      "'specimen_width' (mm); add it, or correct 'moment_unit'",
                                      test.moment_unit));
  if (per_width && test.specimen_width)
    complaints.add(place, fmt::format("[[moment_curvature]] has moments in '{}', which is per width already, and a "
                                      "'specimen_width'; leave it out, or correct 'moment_unit'",
                                      test.moment_unit));
}

void check_cantilever(const toml::node& place, const TestSpec& test, Complaints& complaints) {
  if (test.overhangs.size() > 1 && test.overhangs.size() != test.files.size())
    complaints.add(place, fmt::format("[[cantilever]] has {} 'overhangs' for {} 'files'; give one for each, in the "
                                      "same order, or one for all",
                                      test.overhangs.size(), test.files.size()));
}

void check_peirce(const toml::node& place, const TestSpec& test, Complaints& complaints) {
  const int lists =
      (test.bending_lengths.empty() ? 0 : 1) + (test.overhangs.empty() ? 0 : 1) + (test.rigidities.empty() ? 0 : 1);
  if (lists != 1)
    complaints.add(place, fmt::format("[[peirce]] has {} of 'bending_lengths', 'overhangs' and 'rigidities'; give one "
                                      "of them",
                                      lists == 0 ? "none" : "several"));
}

template <class Check>
void check_each(const toml::table& root, const std::string& name, const std::vector<TestSpec>& tests, Check check,
                Complaints& complaints) {
  for (std::size_t i = 0; i < tests.size(); ++i) check((*root.get_as<toml::array>(name))[i], tests[i], complaints);
}

void check_names(const toml::table& root, const FitSpec& spec, Complaints& complaints) {
  std::set<std::string> names;
  bool any = false;
  for (const auto* tests : {&spec.tensile, &spec.shear_frame, &spec.bias_extension, &spec.moment_curvature,
                            &spec.cantilever, &spec.peirce}) {
    any = any || !tests->empty();
    for (const auto& test : *tests) {
      if (!test.name.empty() && !names.insert(test.name).second)
        complaints.add(root, fmt::format("two tests are called '{}'; give each a name of its own", test.name));
    }
  }
  if (!any)
    complaints.add(root,
                   "the file names no test; add [[tensile]], [[shear_frame]], [[bias_extension]], "
                   "[[moment_curvature]], [[cantilever]] or [[peirce]]");
}

bool rises(const std::array<double, 2>& range) {
  return range[0] < range[1];
}

// Whether every law of the card has a source, measured or kept.
void check_sources(const toml::table& root, const FitSpec& spec, Complaints& complaints) {
  for (std::size_t f = 0; f < yarn_families.size(); ++f) {
    const auto of_yarn = [&](const TestSpec& test) { return stands_for(test, f); };
    const auto tests = std::count_if(spec.tensile.begin(), spec.tensile.end(), of_yarn);
    if (tests > 1)
      complaints.add(root, fmt::format("{} [[tensile]] stand for the {} yarn; put their files into one table", tests,
                                       yarn_families[f]));
    if (tests == 0 && spec.yarn[f].tension.empty())
      complaints.add(root, fmt::format("nothing gives the tension law of the {0} yarn; add [[tensile]] with yarn = "
                                       "\"{0}\", or a 'base' card",
                                       yarn_families[f]));
  }
  if (spec.shear_frame.empty() && spec.bias_extension.empty() && !spec.has_base)
    complaints.add(root, "nothing gives the shear law; add [[shear_frame]], [[bias_extension]] or a 'base' card");
  if (spec.shear.from == ShearSource::shear_frame && spec.shear_frame.empty())
    complaints.add(root, "[shear] takes the law 'from' the shear frame, but there is no [[shear_frame]]; add one");
  if (spec.shear.from == ShearSource::bias_extension && spec.bias_extension.empty())
    complaints.add(root,
                   "[shear] takes the law 'from' the bias extension, but there is no [[bias_extension]]; add one");
  if (!spec.head.thickness && !spec.has_base)
    complaints.add(root, "the file lacks 'thickness' (mm) and no base card gives it; add it, or name a 'base'");
  if ((spec.shear.angles && !rises(*spec.shear.angles)) || !rises(spec.shear.bias_angles))
    complaints.add(root, "'angles' and 'bias_angles' of [shear] must rise: [from, to]");
}

// Whether what the file gives of bending beside its tests of bending can be meant.
void check_bending(const toml::table& root, const FitSpec& spec, Complaints& complaints) {
  const BendingSource from = spec.bending_law.from;
  for (const auto& [source, tests] : {std::pair(BendingSource::moment_curvature, &spec.moment_curvature),
                                      {BendingSource::cantilever, &spec.cantilever},
                                      {BendingSource::peirce, &spec.peirce}})
    if (from == source && tests->empty())
      complaints.add(
          root, fmt::format("[bending_law] takes the law 'from' [[{0}]], but there is none; add one", name_of(source)));
  if (spec.moment_curvature.empty() && spec.cantilever.empty() && spec.peirce.empty()) return;
  if (const toml::node* given = root["bending"]["rigidity"].node())
    complaints.add(*given, "'rigidity' of [bending] is given beside tests that measure it; leave out one of them");
  for (const auto& yarn : {root["yarn"], root["yarn"]["warp"], root["yarn"]["weft"]})
    for (const char* name : {"bending_out_of_plane", "bending_out_of_plane_back"})
      if (const toml::node* given = yarn[name].node())
        complaints.add(
            *given, fmt::format("'{}' is given beside tests of bending, which make it; leave out one of them", name));
}

// Whether the tests that make the law can be simulated, and as the file asks.
void check_simulation(const toml::table& root, const FitSpec& spec, Complaints& complaints) {
  const toml::node* table = root.get("simulation");
  if (spec.shear.method != ShearMethod::simulation) {
    if (table != nullptr)
      complaints.add(*table,
                     "[simulation] does nothing unless [shear] says method = \"simulation\"; add it there, or "
                     "leave the table out");
    return;
  }
  const bool from_frame = spec.shear.from != ShearSource::bias_extension && !spec.shear_frame.empty();
  if (spec.shear_frame.empty() && spec.bias_extension.empty())
    complaints.add(root,
                   "method = \"simulation\" of [shear] needs tests of shear; add [[shear_frame]] or "
                   "[[bias_extension]]");
  for (std::size_t i = 0; from_frame && i < spec.shear_frame.size(); ++i)
    if (const TestSpec& test = spec.shear_frame[i]; !test.frame_length || !test.fabric_length)
      complaints.add((*root.get_as<toml::array>("shear_frame"))[i],
                     "a simulated [[shear_frame]] needs its 'frame_length' and 'fabric_length' (mm); add both");
  if (table == nullptr) return;
  for (const std::string& setting : spec.simulation.settings)
    if (setting.rfind("model.", 0) != 0 && setting.rfind("analysis.", 0) != 0)
      complaints.add(*table, fmt::format("'{}' of 'settings' is none of [model] or [analysis]; the specimen's size and "
                                         "grips are those of its test, and cells have 'coarsening'",
                                         setting));
  if (!spec.simulation.decrimping) return;
  if (from_frame)
    complaints.add(*table,
                   "'decrimping' cannot be told from a shear frame; give from = \"bias_extension\" in [shear], "
                   "or leave it out");
  for (std::size_t f = 0; f < yarn_families.size(); ++f)
    if (!(spec.yarn[f].crimp > 0.0))
      complaints.add(
          *table, fmt::format("'decrimping' needs the 'crimp' (%) of the {} yarn; add it to [yarn]", yarn_families[f]));
}

}  // namespace

double FitSpec::area_weight() const {
  constexpr double tex = 1e-12, standard_gravity = 9806.65;  // tonne/mm, mm/s^2
  double density = 0.0;
  for (const auto& family : yarn) density += family.linear_density * tex / family.interval;
  return density * standard_gravity;
}

FitSpec read_fit(const std::filesystem::path& file) {
  return read_fit_text(read_text_file(file, most_written_by_hand), file.string());
}

FitSpec read_fit_text(const std::string& text, const std::string& name) {
  Complaints complaints(name);
  const toml::table root = parse_toml(text, name);
  FitSpec spec;
  spec.file = name;
  read_keys(root, "a fit file", fit_head_keys(), spec.head, complaints,
            {"yarn", "shear", "simulation", "bending", "tensile", "shear_frame", "bias_extension", "bending_law",
             "moment_curvature", "cantilever", "peirce"});
  require_keys(root, "the fit file", fit_head_keys(), complaints);
  read_base(root, spec, complaints);
  read_yarns(root, spec, complaints);
  if (const auto* table = table_at(root, "bending", "bending", complaints))
    read_keys(*table, "[bending]", bending_keys(), spec.bending, complaints);
  if (const auto* table = table_at(root, "shear", "shear", complaints))
    read_keys(*table, "[shear]", shear_fit_keys(), spec.shear, complaints);
  if (const auto* table = table_at(root, "simulation", "simulation", complaints))
    read_keys(*table, "[simulation]", simulation_keys(), spec.simulation, complaints);
  if (const auto* table = table_at(root, "bending_law", "bending_law", complaints))
    read_keys(*table, "[bending_law]", bending_fit_keys(), spec.bending_law, complaints);
  spec.tensile = read_tests(root, "tensile", tensile_keys(), complaints);
  spec.shear_frame = read_tests(root, "shear_frame", shear_frame_keys(), complaints);
  spec.bias_extension = read_tests(root, "bias_extension", bias_extension_keys(), complaints);
  spec.moment_curvature = read_tests(root, "moment_curvature", moment_curvature_keys(), complaints);
  spec.cantilever = read_tests(root, "cantilever", cantilever_keys(), complaints);
  spec.peirce = read_tests(root, "peirce", peirce_keys(), complaints);
  check_each(root, "tensile", spec.tensile, check_tensile, complaints);
  check_each(root, "shear_frame", spec.shear_frame, check_frame, complaints);
  check_each(root, "bias_extension", spec.bias_extension, check_bias, complaints);
  check_each(root, "moment_curvature", spec.moment_curvature, check_moment_curvature, complaints);
  check_each(root, "cantilever", spec.cantilever, check_cantilever, complaints);
  check_each(root, "peirce", spec.peirce, check_peirce, complaints);
  check_names(root, spec, complaints);
  check_bending(root, spec, complaints);
  check_simulation(root, spec, complaints);
  check_sources(root, spec, complaints);
  complaints.throw_if_any();
  return spec;
}

}  // namespace weaveform::identify
