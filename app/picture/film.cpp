#include "app/picture/film.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/files/text_words.hpp"

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

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  text.erase(0, text.rfind('\n') + 1);
  return text.empty() ? "no reason given" : text;
}

}  // namespace

void make_film(const std::filesystem::path& pattern, const std::filesystem::path& film) {
  std::vector<std::string> words = words_for(pattern, film);
  std::vector<char*> call;
  for (std::string& word : words) call.push_back(word.data());
  call.push_back(nullptr);
  const std::filesystem::path said = pattern.parent_path() / "ffmpeg.log";
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t child = 0;
  const int failure = posix_spawnp(&child, call[0], &files, nullptr, call.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (failure == ENOENT)
    throw FileError("no film without ffmpeg, which is not on the PATH; install it (Debian: apt-get install ffmpeg)");
  if (failure != 0) throw FileError(fmt::format("ffmpeg cannot be started ({})", std::strerror(failure)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw FileError(fmt::format("{}: ffmpeg made no film: {}", film.string(), last_line(read_text_file(said))));
}

}  // namespace weaveform
