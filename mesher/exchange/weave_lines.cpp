#include "mesher/exchange/weave_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/scene_name.hpp"

namespace weaveform {

std::vector<std::string> weave_lines(const Scene& scene, const Mesh& mesh) {
  std::vector<std::string> lines = {"weave 1"};
  const auto add = [&](std::string line) { lines.push_back(std::move(line)); };
  add(fmt::format("size {} {} {} {} {}", mesh.node_count(), mesh.yarn_count(), mesh.cells.size(), mesh.tie.size(),
                  mesh.sets.size()));
  add(fmt::format("spacing {} {}", mesh.spacing[0], mesh.spacing[1]));
  add(fmt::format("lattice {} {}", mesh.lattice_size[0], mesh.lattice_size[1]));
  add(fmt::format("thickness {}", mesh.thickness));
  const auto& corner = mesh.frame.corner;
  add(fmt::format("frame {} {} {} {}", corner[0], corner[1], corner[2], corner[3]));
  for (int n = 0; n < mesh.node_count(); ++n) {
    const auto& x = mesh.nodes.position[n];
    add(fmt::format("node {} {} {} {} {} {}", x[0], x[1], x[2], mesh.nodes.mass[n], mesh.nodes.crossing[n][0],
                    mesh.nodes.crossing[n][1]));
  }
  for (const auto& x : mesh.nodes.flat_position) add(fmt::format("flat {} {} {}", x[0], x[1], x[2]));
  for (int e = 0; e < mesh.yarn_count(); ++e)
    add(fmt::format("yarn {} {} {} {} {} {} {} {}", mesh.yarns.node[e][0], mesh.yarns.node[e][1],
                    static_cast<int>(mesh.yarns.family[e]), mesh.yarns.rest_length[e], mesh.yarns.section[e],
                    mesh.yarns.yarns[e], mesh.yarns.jaw[e], mesh.yarns.softening[e]));
  for (int c = 0; c < mesh.cells.size(); ++c) {
    add(fmt::format("cell {} {} {} {}", mesh.cells.offset[c + 1] - mesh.cells.offset[c], mesh.cells.area[c],
                    mesh.cells.lattice[c][0], mesh.cells.lattice[c][1]));
    for (int k = mesh.cells.offset[c]; k < mesh.cells.offset[c + 1]; ++k)
      add(fmt::format("at {} {} {}", mesh.cells.node[k], mesh.cells.coefficient[k][0], mesh.cells.coefficient[k][1]));
  }
  for (const auto& tie : mesh.tie) add(fmt::format("tie {} {} {} {}", tie.node, tie.to[0], tie.to[1], tie.share));
  for (const auto& set : mesh.sets) {
    add(fmt::format("set {} {}", set.node.size(), set.name));
    for (std::size_t k = 0; k < set.node.size(); k += 12)
      add(fmt::format(
          "in {}", fmt::join(set.node.begin() + static_cast<std::ptrdiff_t>(k),
                             set.node.begin() + static_cast<std::ptrdiff_t>(std::min(k + 12, set.node.size())), " ")));
  }
  add("from " + scene_name_line(scene.file));
  std::istringstream text(scene_to_toml(with_absolute_paths(scene)));
  for (std::string line; std::getline(text, line);) add("scene " + line);
  add("end");
  return lines;
}

namespace {

// Walks the lines and takes words off each; whatever is missing or wrong is an error with its line.
class LineReader {
public:
  LineReader(const std::vector<NumberedLine>& lines, const std::string& file) : lines_(lines), file_(file) {}

  [[noreturn]] void fail(const std::string& what) const {
    const int number = lines_.empty() ? 1 : lines_[std::min(next_ == 0 ? 0 : next_ - 1, lines_.size() - 1)].number;
    throw InputError(
        fmt::format("{}:{}: {}; export the mesh again, or remove the weaveform lines and import it with --scene", file_,
                    number, what));
  }
  // Goes to the next line, which must begin with `word`.
  void expect(const std::string& word) {
    if (!begins(word)) {
      ++next_;
      fail(fmt::format("weaveform line '{} ...' expected", word));
    }
    rest_ = lines_[next_++].text.substr(word.size());
  }
  [[nodiscard]] bool begins(const std::string& word) const {
    if (next_ >= lines_.size()) return false;
    const std::string& text = lines_[next_].text;
    return text.compare(0, word.size(), word) == 0 && (text.size() == word.size() || text[word.size()] == ' ');
  }
  [[nodiscard]] std::string rest() const { return rest_.empty() ? rest_ : rest_.substr(1); }
  template <class Number>
  Number take() {
    const std::size_t from = std::min(rest_.find_first_not_of(' '), rest_.size());
    Number value{};
    const auto [end, error] = std::from_chars(rest_.data() + from, rest_.data() + rest_.size(), value);
    if (error != std::errc() || (end != rest_.data() + rest_.size() && *end != ' ')) fail("a number expected");
    rest_.erase(0, static_cast<std::size_t>(end - rest_.data()));
    return value;
  }
  double real() {
    const double value = take<double>();
    if (!std::isfinite(value)) fail("a finite number expected");
    return value;
  }
  int whole(int least, int below) {
    const int value = take<int>();
    if (value < least || value >= below) fail(fmt::format("{} is not in [{}, {})", value, least, below));
    return value;
  }
  void done() const {
    if (rest_.find_first_not_of(' ') != std::string::npos) fail("more on the line than belongs there");
  }

private:
  const std::vector<NumberedLine>& lines_;
  const std::string& file_;
  std::size_t next_ = 0;
  std::string rest_;
};

constexpr int most_of_anything = 100'000'000;  // of anything in one file

void read_nodes(LineReader& in, int count, MeshNodes& nodes, const std::array<int, 2>& lattice) {
  for (int n = 0; n < count; ++n) {
    in.expect("node");
    std::array<double, 3> x{};
    for (double& c : x) c = in.real();
    const double mass = in.real();
    const int i = in.whole(-1, lattice[0]);
    nodes.add(x, mass, {i, in.whole(-1, lattice[1])});
    in.done();
  }
}

void read_yarns(LineReader& in, int count, int nodes, MeshYarns& yarns) {
  for (int e = 0; e < count; ++e) {
    in.expect("yarn");
    MeshYarn yarn;
    for (int& n : yarn.node) n = in.whole(0, nodes);
    yarn.family = in.whole(0, 2) == 0 ? Family::warp : Family::weft;
    for (double* to : {&yarn.rest_length, &yarn.section, &yarn.yarns, &yarn.jaw, &yarn.softening}) *to = in.real();
    if (!(yarn.rest_length > 0.0)) in.fail("a rest length above 0 expected");
    in.done();
    yarns.add(yarn);
  }
}

void read_cells(LineReader& in, int count, int nodes, MeshCells& cells) {
  for (int c = 0; c < count; ++c) {
    in.expect("cell");
    const int size = in.whole(3, 7);
    const double area = in.real();
    std::array<int, 2> lattice{};
    for (int& index : lattice) index = in.whole(-1, most_of_anything);
    in.done();
    std::vector<int> node;
    std::vector<Vec2> coefficient;
    for (int k = 0; k < size; ++k) {
      in.expect("at");
      node.push_back(in.whole(0, nodes));
      const double warp = in.real();
      coefficient.push_back({warp, in.real()});
      in.done();
    }
    cells.add(node, coefficient, area, lattice);
  }
}

void read_set(LineReader& in, int nodes, std::vector<NodeSet>& sets) {
  in.expect("set");
  const int count = in.whole(0, nodes + 1);
  NodeSet set{in.rest(), {}};
  for (int k = 0; k < count; ++k) {
    if (k % 12 == 0) in.expect("in");
    set.node.push_back(in.whole(0, nodes));
  }
  if (count > 0) in.done();
  sets.push_back(std::move(set));
}

}  // namespace

WovenMesh read_weave_lines(const std::vector<NumberedLine>& lines, const std::string& file) {
  LineReader in(lines, file);
  WovenMesh woven;
  Mesh& mesh = woven.mesh;
  in.expect("weave");
  if (in.whole(0, most_of_anything) != 1) in.fail("only version 1 of the weaveform lines is known");
  in.expect("size");
  std::array<int, 5> size{};
  for (int& count : size) count = in.whole(0, most_of_anything);
  in.expect("spacing");
  for (double& h : mesh.spacing) h = in.real();
  in.expect("lattice");
  for (int& count : mesh.lattice_size) count = in.whole(0, most_of_anything);
  in.expect("thickness");
  mesh.thickness = in.real();
  in.expect("frame");
  for (int& corner : mesh.frame.corner) corner = in.whole(-1, size[0]);
  read_nodes(in, size[0], mesh.nodes, mesh.lattice_size);
  if (in.begins("flat"))
    for (int n = 0; n < size[0]; ++n) {
      in.expect("flat");
      std::array<double, 3> x{};
      for (double& c : x) c = in.real();
      in.done();
      mesh.nodes.flat_position.push_back(x);
    }
  read_yarns(in, size[1], size[0], mesh.yarns);
  read_cells(in, size[2], size[0], mesh.cells);
  for (int k = 0; k < size[3]; ++k) {
    in.expect("tie");
    MeshTie tie;
    tie.node = in.whole(0, size[0]);
    for (int& to : tie.to) to = in.whole(0, size[0]);
    tie.share = in.real();
    mesh.tie.push_back(tie);
  }
  for (int k = 0; k < size[4]; ++k) read_set(in, size[0], mesh.sets);
  if (in.begins("from")) {
    in.expect("from");
    woven.scene_name = scene_name_in(in.rest());
  }
  while (in.begins("scene")) {
    in.expect("scene");
    woven.scene += in.rest() + "\n";
  }
  in.expect("end");
  if (const std::string wrong = mesh.check(); !wrong.empty()) in.fail(wrong);
  return woven;
}

}  // namespace weaveform
