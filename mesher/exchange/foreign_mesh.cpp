#include "mesher/exchange/foreign_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/files/text_words.hpp"

namespace weaveform {

std::string ForeignMesh::where(const ForeignElement& element) const {
  const auto place = static_cast<std::size_t>(element.file);
  const std::string& name = place < files.size() ? files[place] : file;
  return element.line > 0 ? fmt::format("{}:{}", name, element.line) : name;
}

namespace {

std::vector<int> shells_of_instance(const ForeignMesh& mesh, std::size_t instance) {
  std::vector<int> shells;
  for (std::size_t k = 0; k < mesh.shells.size(); ++k)
    if (mesh.shells[k].instance == static_cast<int>(instance)) shells.push_back(static_cast<int>(k));
  return shells;
}

// Of the instance of that name, else of the part's one instance.
std::vector<int> shells_of_part(const ForeignMesh& mesh, const std::string& name) {
  std::vector<std::size_t> of_part;
  for (std::size_t k = 0; k < mesh.instance.size(); ++k) {
    if (!mesh.instance[k].name.empty() && upper(mesh.instance[k].name) == upper(name))
      return shells_of_instance(mesh, k);
    if (upper(mesh.instance[k].part) == upper(name) && !name.empty()) of_part.push_back(k);
  }
  if (of_part.size() > 1)
    throw InputError(fmt::format("{}: part '{}' has {} instances ({}, {} ...); name one of these", mesh.file, name,
                                 of_part.size(), mesh.instance[of_part[0]].name, mesh.instance[of_part[1]].name));
  return of_part.empty() ? std::vector<int>{} : shells_of_instance(mesh, of_part.front());
}

}  // namespace

std::vector<int> shells_named(const ForeignMesh& mesh, const std::string& name) {
  const std::vector<int> part = shells_of_part(mesh, name);
  std::vector<int> set;
  for (const ElementSet& each : mesh.element_sets)
    if (upper(each.name) == upper(name)) set.insert(set.end(), each.shell.begin(), each.shell.end());
  std::sort(set.begin(), set.end());
  set.erase(std::unique(set.begin(), set.end()), set.end());
  if (part.empty()) return set;
  if (set.empty()) return part;
  if (!std::includes(part.begin(), part.end(), set.begin(), set.end()))
    throw InputError(fmt::format("{}: '{}' is a part and an element set with shells of another; rename one of them",
                                 mesh.file, name));
  return set;  // within the part: the shells meant
}

ForeignMesh read_foreign_mesh(const std::filesystem::path& file) {
  const std::string ending = upper(file.extension().string());
  if (ending == ".MSH") return read_msh(file);
  if (ending == ".INP") return read_inp(file);
  throw InputError(fmt::format("{}: the ending '{}' is no mesh known here; give a .msh (Gmsh) or .inp (Abaqus) file",
                               file.string(), file.extension().string()));
}

}  // namespace weaveform
