#include "solver/analysis/checkpoint.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

#include "core/error.hpp"
#include "core/files/digest.hpp"

namespace weaveform {
namespace {

constexpr std::string_view magic = "weaveform checkpoint 10\n";
constexpr std::size_t head_size = magic.size() + 2 * sizeof(std::uint64_t);

void archive_identity(Archive& archive, Identity& identity) {
  constexpr std::size_t most_items = 1 << 16;
  identity.resize(archive.length("items of the identity", identity.size(), 0, most_items));
  for (auto& item : identity) {
    archive.text("a name", item.name);
    archive.text("a value", item.value);
    archive.flag("a flag", item.content);
  }
}

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

template <class T>
T taken(std::string_view bytes, std::size_t at) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

void refuse_another_run(const Identity& found, const Identity& identity, const std::string& name) {
  const auto lines = differences(found, identity);
  if (lines.empty()) return;
  std::vector<std::string> complaints;
  for (const auto& line : lines)
    complaints.push_back(
        fmt::format("{}: {}; go on with what it began with, or start again without --resume", name, line));
  throw InputError(complaints);
}

}  // namespace

void throw_damaged_checkpoint(const std::string& name, const std::string& why) {
  throw FileError(fmt::format("{}: damaged checkpoint ({}); start the run again without --resume", name, why));
}

std::string checkpoint_bytes(const Identity& identity, const ArchiveState& state) {
  std::string bytes(magic);
  bytes.resize(head_size, '\0');
  StateWriter writer(bytes);
  Identity of_run = identity;
  archive_identity(writer, of_run);
  state(writer);
  put(bytes, magic.size(), static_cast<std::uint64_t>(bytes.size()));
  put(bytes, magic.size() + sizeof(std::uint64_t), check_sum(std::string_view(bytes).substr(head_size)));
  return bytes;
}

void read_checkpoint(std::string_view bytes, const Identity& identity, const ArchiveState& state,
                     const std::string& name, CheckSum check) {
  if (!bytes.starts_with(magic) && bytes.substr(0, 2 * magic.size()).find("weaveform checkpoint ") != bytes.npos)
    throw FileError(name +
                    ": a checkpoint of another version of Weaveform; go on with that, or start the run again "
                    "without --resume");
  if (!bytes.starts_with(magic))
    throw_damaged_checkpoint(name, "it does not begin as one of this version of the program");
  if (bytes.size() < head_size) throw_damaged_checkpoint(name, "cut short");
  if (const auto size = taken<std::uint64_t>(bytes, magic.size()); size != bytes.size())
    throw_damaged_checkpoint(name, fmt::format("{} bytes long where it must have {}", bytes.size(), size));
  if (check == CheckSum::compared &&
      taken<std::uint64_t>(bytes, magic.size() + sizeof(std::uint64_t)) != check_sum(bytes.substr(head_size)))
    throw_damaged_checkpoint(name, "its check sum differs");
  try {
    StateReader reader(bytes.substr(head_size));
    Identity found;
    archive_identity(reader, found);
    refuse_another_run(found, identity, name);
    state(reader);
    if (reader.left() > 0) throw DamagedState{"longer than its content"};
  } catch (const DamagedState& damage) {
    throw_damaged_checkpoint(name, damage.why);
  }
}

std::string unsound_member(const ArchiveState& state) {
  StateLook look;
  state(look);
  return look.found();
}

}  // namespace weaveform
