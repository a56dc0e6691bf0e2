// Mesh files of other codes as they stand: nodes, two-node lines, three- and four-node shells, sets, instances of
// parts.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "mesher/exchange/weave_lines.hpp"
#include "mesher/mesh/mesh.hpp"

namespace weaveform {

struct ForeignElement {
  long number = 0;        // its own in the file, or in its part
  int line = 0;           // of the file, for messages
  std::vector<int> node;  // places in ForeignMesh::position; 2: a line, 3 or 4: a shell
  int file = 0;           // place in ForeignMesh::files
  int instance = 0;       // place in ForeignMesh::instance
};

struct ElementSet {
  std::string name;
  std::vector<int> line, shell;  // places in ForeignMesh::lines and shells, rising
};

// A part as it stands in the assembly. A file without parts is one instance without a name.
struct ForeignInstance {
  std::string name, part;
  bool turned = false;  // the assembly's axes are not the part's
};

struct ForeignMesh {
  std::string file;
  std::vector<std::string> files;               // all that were read; `file` is the first
  std::vector<std::array<double, 3>> position;  // mm; of all instances, in the assembly's place
  std::vector<long> number;                     // of each node in the file, or in its part
  std::vector<ForeignElement> lines, shells;    // each in the file's order
  std::vector<NodeSet> node_sets;               // rising; names as written; a name may stand in several parts
  std::vector<ElementSet> element_sets;
  std::vector<std::string> internal_sets;  // in capitals; names of node sets that a preprocessor keeps for itself
  std::vector<ForeignInstance> instance = {{}};
  std::vector<std::string> notes;   // what was read in part only or left out; one line each
  std::vector<NumberedLine> weave;  // what Weaveform wrote beside the mesh; empty in files of others

  // "file:line" of an element, for messages; the file alone where the line is not known.
  [[nodiscard]] std::string where(const ForeignElement& element) const;
};

// The shells of one name, as places in ForeignMesh::shells: of the instance of that name, else of the part's one
// instance, else of the element set. In any case of letters. Empty when nothing has the name. Throws InputError when
// two instances or an instance and a set of other shells share it.
[[nodiscard]] std::vector<int> shells_named(const ForeignMesh& mesh, const std::string& name);

// MSH 2.2, 4.1, in text or binary: lines, triangles, quadrilaterals, points; of second-order elements the corners.
// Physical groups become sets of nodes and elements. Volumes are left out with a note.
//
// Abaqus input (Analysis User's Manual, "Input syntax rules"): *PART, *ASSEMBLY and *INSTANCE with translation and
// rotation, *NODE, *ELEMENT (trusses, beams, membranes, shells, rigid and plane elements; inp_types.hpp), *NSET and
// *ELSET with GENERATE, sets of sets and INSTANCE=; *INCLUDE and INPUT= relative to the file they stand in. Other
// blocks are passed over; what would change the mesh unseen (*NGEN, *SYSTEM, ...) is refused by name.
//
// By the ending .msh or .inp. Throws FileError (unreadable), InputError "file:line: what is wrong; what to do".
[[nodiscard]] ForeignMesh read_foreign_mesh(const std::filesystem::path& file);
[[nodiscard]] ForeignMesh read_msh(const std::filesystem::path& file);
[[nodiscard]] ForeignMesh read_inp(const std::filesystem::path& file);

}  // namespace weaveform
