// A DXF drawing as it is written (Autodesk, "DXF Reference"): header unit, layers, blocks and entities, each a list of
// group codes with their values.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace weaveform {

struct DxfPair {
  int code = 0;
  std::string_view value;  // trimmed; of the text that was read
  int line = 0;            // of the value, from 1
};

struct DxfEntity {
  std::string type;
  int line = 0;
  std::vector<DxfPair> pairs;       // without the type's own
  std::vector<DxfEntity> vertices;  // of a POLYLINE

  [[nodiscard]] const DxfPair* find(int code) const;  // the first; nullptr when there is none
  [[nodiscard]] std::string text(int code) const;     // "" when there is none
};

struct DxfBlock {
  std::array<double, 2> base = {0.0, 0.0};
  std::vector<DxfEntity> entities;
};

struct DxfDrawing {
  std::string file;
  std::optional<double> unit;              // mm; $INSUNITS, none when the file does not tell
  std::map<std::string, DxfBlock> blocks;  // by name in capitals
  std::set<std::string> hidden;            // layers that are off or frozen, in capitals
  std::vector<DxfEntity> entities;         // of the model, not of paper space
};

// Text DXF of any version. `text` must outlive the drawing. Throws InputError, "file:line: what is wrong; what to do":
// binary DXF, DWG, a file that is none of them or was cut short, a unit that is no length here.
[[nodiscard]] DxfDrawing read_drawing(std::string_view text, const std::string& file);

// Numbers of pairs. Throw InputError with the line.
[[nodiscard]] double dxf_real(const DxfDrawing& drawing, const DxfPair& pair);
[[nodiscard]] long dxf_whole(const DxfDrawing& drawing, const DxfPair& pair);
[[nodiscard]] double dxf_real(const DxfDrawing& drawing, const DxfEntity& entity, int code, double otherwise);
[[nodiscard]] long dxf_whole(const DxfDrawing& drawing, const DxfEntity& entity, int code, long otherwise);

}  // namespace weaveform
