// A blank's boundary as closed loops of points in the blank's own frame (mm), made sound: every loop closed and simple,
// no two crossing, outer ones counter-clockwise and holes clockwise.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace weaveform {

struct OutlineLoop {
  std::vector<std::array<double, 2>> point;  // mm; the last joins the first
  std::vector<std::string> place;            // of each point, for messages: "blank.csv:12"; may be empty
};

// Turns loops by how deep they lie in one another (even: fabric, odd: hole). Adds one line per trouble to `complaints`:
// fewer than three different points, edges that cross or touch, no area. `what` names the outline, e.g. its file.
[[nodiscard]] std::vector<OutlineLoop> sound_loops(std::vector<OutlineLoop> loops, const std::string& what,
                                                   std::vector<std::string>& complaints);

// mm^2; signed, positive counter-clockwise.
[[nodiscard]] double signed_area(const std::vector<std::array<double, 2>>& point);

// A closed polyline file: rows "x,y" in mm (comma, semicolon or blanks between), loops parted by blank lines, lines
// that begin with '#' and one heading skipped. A loop is closed when its last point repeats its first; an open one is a
// complaint. Throws FileError when the file cannot be read.
[[nodiscard]] std::vector<OutlineLoop> read_outline_csv(const std::string& file, std::vector<std::string>& complaints);

// An ellipse of the given extents as a polygon of the very same area.
[[nodiscard]] OutlineLoop ellipse_loop(const std::array<double, 2>& extent);

}  // namespace weaveform
