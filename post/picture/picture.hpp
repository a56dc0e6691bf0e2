// Pictures of a result: the fabric coloured by a field, the tools as glass, a colour bar and a scale, drawn off-screen by
// VTK's rendering, which needs an X server to be there (a virtual one will do).
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/result/result_folder.hpp"

namespace weaveform {

// From where: what suits (a flat blank from above, a part from above at a slant), along -z, along y, or along -x.
enum class View { automatic, top, front, side, slant };

struct PictureSpec {
  std::string field = "absolute_shear_angle_deg";  // an array of the frames on cells; those of field_titles have words
  std::optional<std::array<double, 2>> range;      // of the colours; none: of the field over the frames drawn
  View view = View::automatic;
  std::array<int, 2> size = {1200, 900};  // pixels
  bool tools = true;
  bool yarns = true;  // the lattice as thin lines, where there are not too many to be seen
};

// What the arrays of a frame are called in words, with their unit.
struct FieldTitle {
  const char* array;
  const char* title;
  bool two_signs, from_zero;
};
[[nodiscard]] const std::vector<FieldTitle>& field_titles();

// One view and one range of colours for all frames drawn. Throws FileError and InputError as ResultFolder does, and
// InputError for a field that the frames lack.
class Pictures {
public:
  // `frames` are places in frames_to_draw(folder), one at least.
  Pictures(ResultFolder& folder, PictureSpec spec, const std::vector<std::size_t>& frames);
  ~Pictures();
  Pictures(const Pictures&) = delete;
  Pictures& operator=(const Pictures&) = delete;

  // PNG; throws FileError.
  void draw(std::size_t frame, const std::filesystem::path& file);

private:
  struct Stage;
  std::unique_ptr<Stage> stage_;
};

}  // namespace weaveform
