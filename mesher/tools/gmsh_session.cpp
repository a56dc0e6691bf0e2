#include "mesher/tools/gmsh_session.hpp"

#include <fmt/format.h>
#include <gmsh.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/files/text_words.hpp"
#include "core/guard/guarded.hpp"
#include "mesher/tools/geo_script.hpp"
#include "mesher/tools/late_gmsh.hpp"
#include "mesher/tools/opencascade.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

constexpr double reading_bytes_per_second = 1e5;  // well below what OpenCASCADE reads of a sound file

const char* name_of(CadFormat format) {
  switch (format) {
    case CadFormat::step:
      return "STEP";
    case CadFormat::iges:
      return "IGES";
    default:
      return "BREP";
  }
}

// A script that was looked at, as a file in memory: Gmsh reads those bytes and no others, and looks beside it for none
// (FILE.opt, which it would run as well).
class ScriptInMemory {
public:
  explicit ScriptInMemory(std::string_view text, const fs::path& file) : number_(memfd_create("script", MFD_CLOEXEC)) {
    for (std::size_t at = 0; number_ >= 0 && at < text.size();) {
      const ssize_t part = write(number_, text.data() + at, text.size() - at);
      if (part <= 0) throw FileError(fmt::format("{}: no memory to hold it ({})", file.string(), std::strerror(errno)));
      at += static_cast<std::size_t>(part);
    }
  }
  ~ScriptInMemory() { close(number_); }
  ScriptInMemory(const ScriptInMemory&) = delete;
  ScriptInMemory& operator=(const ScriptInMemory&) = delete;
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] std::string path() const { return fmt::format("/proc/self/fd/{}", number_); }

private:
  int number_;
};

// What Gmsh logged as an error, the script's name in memory put right.
std::string words_of_gmsh(const std::string& thrown, const std::string& path, const fs::path& file) {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  std::string text;
  constexpr std::string_view mark = "Error: ";
  for (const std::string& line : log)
    if (line.starts_with(mark) && text.size() < 300) text += (text.empty() ? "" : "; ") + line.substr(mark.size());
  if (text.empty()) text = thrown;
  for (std::size_t at = 0; !path.empty() && (at = text.find(path, at)) != std::string::npos;)
    text.replace(at, path.size(), file.filename().string());
  text.erase(std::remove_if(text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }),
             text.end());
  return text;
}

void open_in_gmsh(CadFormat format, const std::string& path) {
  gmsh::initialize(0, nullptr, false);
  gmsh::logger::start();
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
  if (format == CadFormat::script) {
    gmsh::merge(path);
  } else {
    opencascade().pass_on(format, path, [](const void* shape) {
      gmsh::vectorpair made;
      gmsh::model::occ::importShapesNativePointer(shape, made, false);
    });
  }
  gmsh::model::occ::synchronize();
  gmsh::option::setNumber("General.NumThreads", 1);  // a script may have set it
  if (format != CadFormat::script) guarded_reading_is_done();
}

// OpenCASCADE goes on for ever over files of another kind. Each format says early what it is: STEP in its first line,
// BREP in one of its first, IGES by the S in column 73 that marks lines of its start section.
void require_begins_as(CadFormat format, const fs::path& file) {
  std::string text(4096, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  bool fits = false;
  if (format == CadFormat::step) fits = text.find("ISO-10303-21") != std::string::npos;
  if (format == CadFormat::brep)
    fits = text.find("DBRep_DrawableShape") != std::string::npos || text.find("CASCADE Topology") != std::string::npos;
  constexpr std::size_t iges_mark = 72;
  if (format == CadFormat::iges) {
    const std::size_t begin = text.find_first_not_of("\r\n");
    fits = begin != std::string::npos && text.size() > begin + iges_mark &&
           std::string_view("SBC").find(text[begin + iges_mark]) != std::string_view::npos;
  }
  if (!fits)
    throw InputError(fmt::format("{}: does not begin as {} files do; end its name in what it is, or write it again",
                                 file.string(), name_of(format)));
}

CadWatcher& watcher() {
  static CadWatcher watch;
  return watch;
}

// Tells that it is done as well, whatever comes of it.
class Watched {
public:
  explicit Watched(const fs::path& file) : file_(file) {}
  ~Watched() { tell(1.0); }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;
  void tell(double fraction) const {
    if (watcher()) watcher()(file_, fraction);
  }

private:
  const fs::path& file_;
};

}  // namespace

CadFormat cad_format(const fs::path& file) {
  static const std::map<std::string, CadFormat> formats = {
      {".step", CadFormat::step}, {".stp", CadFormat::step}, {".iges", CadFormat::iges}, {".igs", CadFormat::iges},
      {".brep", CadFormat::brep}, {".brp", CadFormat::brep}, {".geo", CadFormat::script}};
  const std::string ending = lower(file.extension().string());
  const auto found = formats.find(ending);
  return found == formats.end() ? CadFormat::none : found->second;
}

std::string with_cad_file(const fs::path& file, const CadWork& work, const fs::path& writable_folder) {
  require_regular_file(file);
  // not in the child, which would load them anew for every file
  (void)opencascade();
  const CadFormat format = cad_format(file);
  const bool is_script = format == CadFormat::script;
  if (is_script) load_gmsh();
  Guard guard{.file = file.string(),
              .what = is_script ? "the reader of Gmsh scripts" : fmt::format("the reader of {} files", name_of(format)),
              .remedy = "the file may be damaged: write it again, simpler, in another CAD format, or as STL",
              .writable_folder = writable_folder};
  const Watched watched(file);
  if (watcher()) guard.while_it_works = [&](double fraction) { watched.tell(fraction); };
  if (!is_script) {
    require_begins_as(format, file);
    guard.reading_seconds = 10.0 + static_cast<double>(fs::file_size(file)) / reading_bytes_per_second;
    return run_guarded(guard, [&] { return work(format, file.string()); });
  }
  if (geo_scripts_are_trusted()) {
    guard.may_act = true;
    return run_guarded(guard, [&] { return work(format, file.string()); });
  }
  const ScriptInMemory script(geometry_script(read_text_file(file), file.string()), file);
  guard.open_file = script.number();
  return run_guarded(guard, [&] { return work(format, script.path()); });
}

std::string open_gmsh(CadFormat format, const std::string& path, const fs::path& file,
                      const std::function<std::string()>& work) {
  const auto failed = [&](const std::string& thrown) {
    return InputError(
        fmt::format("{}: Gmsh cannot read or mesh this geometry ({}); mend it, or write it as STEP or STL",
                    file.string(), words_of_gmsh(thrown, path, file)));
  };
  try {
    open_in_gmsh(format, path);
    return work();
  } catch (const InputError&) {
    throw;
  } catch (const std::string& thrown) {
    throw failed(thrown);
  } catch (const std::runtime_error& thrown) {
    throw failed(thrown.what());
  } catch (int) {
    throw failed("no reason given");
  }
}

std::string with_gmsh(const fs::path& file, const std::function<std::string()>& work, const fs::path& writable_folder) {
  load_gmsh();
  return with_cad_file(
      file, [&](CadFormat format, const std::string& path) { return open_gmsh(format, path, file, work); },
      writable_folder);
}

void watch_cad_reading(CadWatcher watch) {
  watcher() = std::move(watch);
}

}  // namespace weaveform
