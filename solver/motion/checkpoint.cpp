#include "solver/motion/checkpoint.hpp"

#include <cstdint>
#include <fstream>
#include <type_traits>

#include "mesher/base/error.hpp"
#include "mesher/base/files.hpp"

namespace weaveform {
namespace {

constexpr char magic[] = "weaveform checkpoint 2";

// One description of the layout serves both ways: `Archive` is a writer or a reader.
class Writer {
public:
  explicit Writer(std::ofstream& stream) : stream_(stream) {}
  template <class T>
  void raw(const T* data, std::size_t count) {
    stream_.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(count * sizeof(T)));
  }
  void operator()(const std::string& text) { list(text); }
  template <class T>
  void operator()(const T& value) {
    if constexpr (std::is_arithmetic_v<T>)
      raw(&value, 1);
    else
      list(value);
  }

private:
  template <class List>
  void list(const List& values) {
    const std::uint64_t count = values.size();
    raw(&count, 1);
    if constexpr (std::is_arithmetic_v<typename List::value_type>)
      raw(values.data(), count);
    else
      for (const auto& value : values) (*this)(value);
  }
  std::ofstream& stream_;
};

class Reader {
public:
  Reader(std::ifstream& stream, std::string file) : stream_(stream), file_(std::move(file)) {}
  template <class T>
  void raw(T* data, std::size_t count) {
    stream_.read(reinterpret_cast<char*>(data), static_cast<std::streamsize>(count * sizeof(T)));
    if (!stream_) throw FileError(file_ + ": the checkpoint is cut short; start the run again without --resume");
  }
  template <class T>
  void operator()(T& value) {
    if constexpr (std::is_arithmetic_v<T>)
      raw(&value, 1);
    else
      list(value);
  }

private:
  template <class List>
  void list(List& values) {
    std::uint64_t count = 0;
    raw(&count, 1);
    constexpr std::uint64_t sane = 1ULL << 36;
    if (count > sane) throw FileError(file_ + ": the checkpoint is damaged; start the run again without --resume");
    values.resize(count);
    if constexpr (std::is_arithmetic_v<typename List::value_type>)
      raw(values.data(), count);
    else
      for (auto& value : values) (*this)(value);
  }
  std::ifstream& stream_;
  std::string file_;
};

template <class Archive, class C>
void transfer(Archive& archive, C& c) {
  for (int k = 0; k < 3; ++k) {
    archive(c.state.position[k]);
    archive(c.state.velocity[k]);
    archive(c.state.force[k]);
  }
  archive(c.state.time);
  archive(c.state.step);
  for (auto* value :
       {&c.step_before, &c.step, &c.smallest_step, &c.viscous_time, &c.power_before, &c.wall_s, &c.balance.internal,
        &c.balance.kinetic, &c.balance.damping, &c.balance.external, &c.balance.start, &c.balance.greatest,
        &c.grip_work, &c.damping_work, &c.worst_error, &c.worst_ratio, &c.path.work, &c.window.elapsed})
    archive(*value);
  for (auto* strains : {&c.reach.allowed, &c.reach.reached})
    for (auto& range : *strains) {
      archive(range.least);
      archive(range.greatest);
    }
  for (auto* value : {&c.next_row, &c.next_frame, &c.folded, &c.window.row}) archive(*value);
  archive(c.force_before);
  archive(c.displacement_before);
  archive(c.path.stress);
  archive(c.path.log_stretch);
  archive(c.cell_history);
  archive(c.term_memory);
  archive(c.history.column);
  archive(c.history.row);
  archive(c.window.impulse);
}

}  // namespace

void write_checkpoint(const Checkpoint& checkpoint, const std::string& identity, const std::filesystem::path& file) {
  write_whole(file, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    Writer writer(stream);
    writer(std::string(magic));
    writer(identity);
    transfer(writer, checkpoint);
    stream.close();
    if (!stream)
      throw FileError(file.string() + ": cannot write the checkpoint; free disk space or choose another folder");
  });
}

Checkpoint read_checkpoint(const std::string& identity, const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(file.string() + ": no checkpoint to resume from; run without --resume");
  Reader reader(stream, file.string());
  std::string head, found;
  reader(head);
  if (head != magic) throw InputError(file.string() + ": not a checkpoint of this version; run without --resume");
  reader(found);
  if (found != identity)
    throw InputError(file.string() + ": the checkpoint belongs to another scene or mesh; run without --resume");
  Checkpoint checkpoint;
  transfer(reader, checkpoint);
  return checkpoint;
}

}  // namespace weaveform
