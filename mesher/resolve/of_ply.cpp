#include "mesher/resolve/of_ply.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/error.hpp"

namespace weaveform {
namespace {

std::string with_ply(const std::string& line, const std::string& file, const std::string& ply) {
  const std::string name = fmt::format("ply '{}': ", ply);
  const std::string before = file + ": ";
  return !file.empty() && line.starts_with(before) ? before + name + line.substr(before.size()) : name + line;
}

}  // namespace

void of_ply(const Resolved& model, std::size_t ply, const std::function<void()>& look) {
  const auto renamed = [&](const std::vector<std::string>& complaints) {
    std::vector<std::string> lines;
    for (const std::string& line : complaints)
      lines.push_back(with_ply(line, model.scene.file, model.scene.ply[ply].name));
    return lines;
  };
  try {
    look();
  } catch (const InputError& error) {
    throw InputError(renamed(error.complaints()));
  } catch (const FileError& error) {
    throw FileError(renamed(error.complaints()));
  } catch (const PhysicsError& error) {
    throw PhysicsError(with_ply(error.what(), model.scene.file, model.scene.ply[ply].name));
  }
}

}  // namespace weaveform
