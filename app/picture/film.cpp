#include "app/picture/film.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/files/text_words.hpp"
#include "core/guard/run_program.hpp"

namespace weaveform {
namespace {

constexpr const char* pictures_per_second = "10";

std::vector<std::string> words_for(const std::filesystem::path& pattern, const std::filesystem::path& film) {
  std::vector<std::string> words = {"ffmpeg",     "-nostdin",          "-loglevel", "error",         "-y",
                                    "-framerate", pictures_per_second, "-i",        pattern.string()};
  if (lower(film.extension().string()) == ".gif")
    // one palette for the film: made from all its pictures, so that a colour means the same throughout
    words.insert(words.end(),
                 {"-filter_complex", "split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=none", "-loop", "0"});
  else
    words.insert(words.end(), {"-c:v", "libvpx-vp9", "-pix_fmt", "yuv420p", "-b:v", "0", "-crf", "32"});
  words.push_back(film.string());
  return words;
}

}  // namespace

void make_film(const std::filesystem::path& pattern, const std::filesystem::path& film) {
  const std::string purpose = "no film can be made";
  const ProgramEnd end = run_program(words_for(pattern, film), "", purpose, "ffmpeg");
  if (end.signal != 0) throw FileError(fmt::format("{}: ffmpeg was ended by signal {}", purpose, end.signal));
  if (end.exit_code != 0)
    throw FileError(fmt::format("{}: {}: ffmpeg said: {}", purpose, film.string(), end.complaint));
}

}  // namespace weaveform
