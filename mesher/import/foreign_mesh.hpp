// Mesh files of other codes as they stand: nodes, two-node lines, three- and four-node shells, sets.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "mesher/export/weave_lines.hpp"
#include "mesher/mesh/mesh.hpp"

namespace weaveform {

struct ForeignElement {
  long number = 0;        // its own in the file
  int line = 0;           // of the file, for messages
  std::vector<int> node;  // places in ForeignMesh::position; 2: a line, 3 or 4: a shell
};

struct ElementSet {
  std::string name;
  std::vector<long> element;  // numbers, in the file's order
};

struct ForeignMesh {
  std::string file;
  std::vector<std::array<double, 3>> position;  // mm
  std::vector<long> number;                     // of each node in the file
  std::vector<ForeignElement> lines, shells;    // each in the file's order
  std::vector<NodeSet> node_sets;               // rising; names as written
  std::vector<ElementSet> element_sets;
  std::vector<NumberedLine> weave;  // what Weaveform wrote beside the mesh; empty in files of others
};

// MSH 4.1 ASCII: lines, triangles, quadrilaterals, points; physical groups become sets of nodes and elements.
// Abaqus input: *NODE, *ELEMENT (T3D2, B31, M3D3, M3D4, M3D4R, S3, S3R, S4, S4R, R3D3, R3D4; MASS is passed over),
// *NSET and *ELSET with GENERATE and sets of sets; other blocks are passed over, *INCLUDE and moved instances refused.
// By the ending .msh or .inp. Throws FileError (unreadable), InputError "file:line: what is wrong; what to do".
[[nodiscard]] ForeignMesh read_foreign_mesh(const std::filesystem::path& file);
[[nodiscard]] ForeignMesh read_msh(const std::filesystem::path& file);
[[nodiscard]] ForeignMesh read_inp(const std::filesystem::path& file);

}  // namespace weaveform
