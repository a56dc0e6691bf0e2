// A film from pictures, by ffmpeg.
#pragma once

#include <filesystem>

namespace weaveform {

// `pattern` names the pictures with their number from 0, as "DIR/frame_%04d.png"; the kind of film follows from the
// ending of `film` (.gif, .webm). Throws FileError when there is no ffmpeg, or it fails, with its last line.
void make_film(const std::filesystem::path& pattern, const std::filesystem::path& film);

}  // namespace weaveform
