#include "solver/analysis/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "core/error.hpp"
#include "core/files/digest.hpp"

namespace weaveform {
namespace {

constexpr std::string_view magic = "weaveform checkpoint 4\n";
constexpr std::size_t head_size = magic.size() + 2 * sizeof(std::uint64_t);
constexpr std::size_t longest_text = 1 << 16;
constexpr double greatest_step_count = 0x1.0p53;

// One description of the layout serves both ways: an archive writes what it is given, or reads into it.
class Writer {
public:
  template <class T>
  void number(T& value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class List>
  void list(const char* /*what*/, const List& values, std::size_t /*least*/, std::size_t /*most*/) {
    std::uint64_t count = values.size();
    number(count);
    if constexpr (std::is_arithmetic_v<typename List::value_type>)
      bytes_.append(reinterpret_cast<const char*>(values.data()), count * sizeof(values[0]));
  }
  void text(const char* what, const std::string& value) { list(what, value, 0, longest_text); }
  void flag(bool value) {
    std::uint8_t byte = value ? 1 : 0;
    number(byte);
  }
  std::string& bytes() { return bytes_; }

private:
  std::string bytes_;
};

class Reader {
public:
  Reader(std::string_view bytes, const std::string& name) : left_(bytes), name_(name) {}
  template <class T>
  void number(T& value) {
    static_assert(std::is_arithmetic_v<T>);
    take(&value, sizeof value);
  }
  template <class List>
  void list(const char* what, List& values, std::size_t least, std::size_t most) {
    std::uint64_t count = 0;
    number(count);
    if (count < least || count > most)
      throw_damaged_checkpoint(name_, fmt::format("{} entries of {} where there must be {}{}", count, what, least,
                                                  least == most ? "" : fmt::format(" to {}", most)));
    if constexpr (std::is_arithmetic_v<typename List::value_type>) {
      if (count > left_.size() / sizeof(values[0])) throw_damaged_checkpoint(name_, "cut short");
      values.resize(count);
      if (count > 0) take(values.data(), count * sizeof(values[0]));
    } else {
      if (count > left_.size() / sizeof(count)) throw_damaged_checkpoint(name_, "cut short");  // each has a length
      values.resize(count);
    }
  }
  void text(const char* what, std::string& value) { list(what, value, 0, longest_text); }
  void flag(bool& value) {
    std::uint8_t byte = 0;
    number(byte);
    if (byte > 1) throw_damaged_checkpoint(name_, "a flag that is neither set nor not");
    value = byte == 1;
  }
  [[nodiscard]] std::size_t left() const { return left_.size(); }

private:
  void take(void* to, std::size_t size) {
    if (size > left_.size()) throw_damaged_checkpoint(name_, "cut short");
    std::memcpy(to, left_.data(), size);
    left_.remove_prefix(size);
  }
  std::string_view left_;
  const std::string& name_;
};

template <class C>
auto scalars_of(C& c) {
  return std::array{&c.state.time,
                    &c.step_before,
                    &c.step,
                    &c.smallest_step,
                    &c.viscous_time,
                    &c.power_before,
                    &c.wall_s,
                    &c.balance.internal,
                    &c.balance.kinetic,
                    &c.balance.damping,
                    &c.balance.external,
                    &c.balance.bending,
                    &c.balance.hourglass,
                    &c.balance.start,
                    &c.balance.greatest,
                    &c.grip_work,
                    &c.damping_work,
                    &c.worst_error,
                    &c.worst_ratio,
                    &c.path.work,
                    &c.window.elapsed,
                    &c.reach.allowed[0].least,
                    &c.reach.allowed[0].greatest,
                    &c.reach.allowed[1].least,
                    &c.reach.allowed[1].greatest,
                    &c.reach.reached[0].least,
                    &c.reach.reached[0].greatest,
                    &c.reach.reached[1].least,
                    &c.reach.reached[1].greatest};
}

template <class C>
auto counters_of(C& c) {
  return std::array{&c.next_row, &c.next_frame, &c.folded};
}

template <class Archive, class C>
void transfer(Archive& archive, C& c, const CheckpointSizes& size) {
  for (auto* field : {&c.state.position, &c.state.velocity, &c.state.force})
    for (auto& component : *field) archive.list("a field of the nodes", component, size.nodes, size.nodes);
  for (auto* value : scalars_of(c)) archive.number(*value);
  for (auto* value : counters_of(c)) archive.number(*value);
  archive.number(c.state.step);
  archive.number(c.window.row);
  archive.text("a name", c.step_set_by);
  archive.list("grip forces", c.force_before, size.grips, size.grips);
  archive.list("grip displacements", c.displacement_before, size.grips, size.grips);
  archive.list("frames", c.frame_times, 0, size.frames);
  archive.list("cell stresses", c.path.stress, 0, size.path_cells);
  archive.list("cell stretches", c.path.log_stretch, c.path.stress.size(), c.path.stress.size());
  archive.list("cell history", c.fabric, size.fabric, size.fabric);
  archive.list("force terms", c.term_memory, size.term.size(), size.term.size());
  for (std::size_t k = 0; k < c.term_memory.size(); ++k)
    archive.list("a force term's memory", c.term_memory[k], size.term.empty() ? 0 : size.term[k],
                 size.term.empty() ? 0 : size.term[k]);
  archive.list("rows of history", c.row, 0, size.rows);
  for (auto& row : c.row) archive.list("values of a row", row, size.columns, size.columns);
  archive.list("impulses", c.window.impulse, size.impulses, size.impulses);
}

template <class Archive, class Items>
void transfer_identity(Archive& archive, Items& identity) {
  constexpr std::size_t most_items = 1 << 16;
  archive.list("items of the identity", identity, 0, most_items);
  for (auto& item : identity) {
    archive.text("a name", item.name);
    archive.text("a value", item.value);
    archive.flag(item.content);
  }
}

template <class List>
bool finite(const List& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

bool is_finite(const Checkpoint& c) {
  for (const auto* field : {&c.state.position, &c.state.velocity, &c.state.force})
    for (const auto& component : *field)
      if (!finite(component)) return false;
  for (const double* value : scalars_of(c))
    if (!std::isfinite(*value)) return false;
  for (const auto* list : {&c.force_before, &c.displacement_before, &c.frame_times, &c.path.stress, &c.path.log_stretch,
                           &c.fabric, &c.window.impulse})
    if (!finite(*list)) return false;
  return true;
}

namespace {

bool is_range(const StrainRange& range, double most) {
  return range.least <= 0.0 && range.greatest >= 0.0 && range.least >= -most && range.greatest <= most;
}

// What follows from the scene and from each other.
std::string contradiction(const Checkpoint& c, const CheckpointSizes& size) {
  if (!is_finite(c)) return "not a number";
  const auto rows = static_cast<std::int64_t>(c.row.size()), frames = static_cast<std::int64_t>(c.frame_times.size());
  if (c.state.step < 0 || static_cast<double>(c.state.step) > greatest_step_count || c.state.time < 0.0 ||
      c.state.time > size.duration)
    return "a time outside the run";
  if (c.step <= 0.0 || c.step_before < 0.0 || c.smallest_step <= 0.0 || c.viscous_time < 0.0 || c.wall_s < 0.0)
    return "a step or time below zero";
  if (c.next_row < rows || c.next_row > static_cast<std::int64_t>(size.rows) || c.next_frame < frames ||
      c.next_frame > static_cast<std::int64_t>(size.frames))
    return "a counter out of range";
  if (c.window.row < 0 || c.window.row > rows || c.window.elapsed < 0.0) return "a row out of range";
  if (!c.path.stress.empty() && c.path.stress.size() != size.path_cells) return "a path of other cells";
  if (!std::is_sorted(c.frame_times.begin(), c.frame_times.end())) return "frames out of order";
  for (const auto& range : c.reach.allowed)
    if (!is_range(range, torn_strain)) return "a strain out of range";
  constexpr double any_strain = 1e3;
  for (const auto& range : c.reach.reached)
    if (!is_range(range, any_strain)) return "a strain out of range";
  return "";
}

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

}  // namespace

void throw_damaged_checkpoint(const std::string& name, const std::string& why) {
  throw FileError(fmt::format("{}: damaged checkpoint ({}); start the run again without --resume", name, why));
}

std::string checkpoint_bytes(const Checkpoint& checkpoint, const Identity& identity) {
  Writer writer;
  writer.bytes() = magic;
  writer.bytes().resize(head_size, '\0');
  transfer_identity(writer, identity);
  transfer(writer, checkpoint, CheckpointSizes{});
  std::string& bytes = writer.bytes();
  put(bytes, magic.size(), static_cast<std::uint64_t>(bytes.size()));
  put(bytes, magic.size() + sizeof(std::uint64_t), check_sum(std::string_view(bytes).substr(head_size)));
  return std::move(bytes);
}

Checkpoint read_checkpoint(std::string_view bytes, const Identity& identity, const CheckpointSizes& expected,
                           const std::string& name, CheckSum check) {
  if (!bytes.starts_with(magic) && bytes.substr(0, 2 * magic.size()).find("weaveform checkpoint ") != bytes.npos)
    throw FileError(name +
                    ": a checkpoint of another version of Weaveform; go on with that, or start the run again "
                    "without --resume");
  if (!bytes.starts_with(magic))
    throw_damaged_checkpoint(name, "it does not begin as one of this version of the program");
  Reader head(bytes.substr(magic.size()), name);
  std::uint64_t size = 0, sum = 0;
  head.number(size);
  head.number(sum);
  if (size != bytes.size())
    throw_damaged_checkpoint(name, fmt::format("{} bytes long where it must have {}", bytes.size(), size));
  if (check == CheckSum::compared && sum != check_sum(bytes.substr(head_size)))
    throw_damaged_checkpoint(name, "its check sum differs");

  Reader reader(bytes.substr(head_size), name);
  Identity found;
  transfer_identity(reader, found);
  if (const auto lines = differences(found, identity); !lines.empty()) {
    std::vector<std::string> complaints;
    for (const auto& line : lines)
      complaints.push_back(
          fmt::format("{}: {}; go on with what it began with, or start again without --resume", name, line));
    throw InputError(complaints);
  }
  Checkpoint checkpoint;
  transfer(reader, checkpoint, expected);
  if (reader.left() > 0) throw_damaged_checkpoint(name, "longer than its content");
  if (const std::string what = contradiction(checkpoint, expected); !what.empty()) throw_damaged_checkpoint(name, what);
  return checkpoint;
}

}  // namespace weaveform
