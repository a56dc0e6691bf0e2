// The program that draws for `weaveform render` (app/commands/render.cpp), which alone is linked with VTK's rendering.
#include <fmt/format.h>
#include <vtkObject.h>

#include <cstdlib>
#include <numeric>

#include "app/console.hpp"
#include "app/picture/film.hpp"
#include "app/picture/picture_options.hpp"
#include "app/process.hpp"
#include "app/stages/output_folder.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/files/text_words.hpp"
#include "post/picture/picture.hpp"
#include "post/picture/sheet.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

// A folder for a film's pictures, removed at the end.
class PictureFolder {
public:
  PictureFolder() {
    std::string name = (fs::temp_directory_path() / "weaveform-film-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw FileError(fmt::format("{}: no folder for the pictures of a film", name));
    path_ = name;
  }
  ~PictureFolder() {
    std::error_code unimportant;
    fs::remove_all(path_, unimportant);
  }
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

View view_named(const std::string& name) {
  if (name == "top") return View::top;
  if (name == "front") return View::front;
  if (name == "side") return View::side;
  return name == "slant" ? View::slant : View::automatic;
}

PictureSpec spec_of(const PictureArguments& arguments) {
  PictureSpec spec;
  spec.field = arguments.field;
  spec.view = view_named(arguments.view);
  spec.size = {arguments.size[0], arguments.size[1]};
  spec.tools = !arguments.without_tools;
  spec.yarns = !arguments.without_yarns;
  if (!arguments.range.empty()) spec.range = {arguments.range[0], arguments.range[1]};
  if (spec.range && !((*spec.range)[1] > (*spec.range)[0]))
    throw InputError(fmt::format("--range {:g} {:g}: the colours need a second end above the first", arguments.range[0],
                                 arguments.range[1]));
  return spec;
}

void require_ending(const PictureArguments& arguments) {
  const std::string ending = lower(fs::path(arguments.output).extension().string());
  const bool fits = arguments.animate ? ending == ".gif" || ending == ".webm" : ending == ".png";
  if (!fits)
    throw InputError(
        fmt::format("{}: {}; end its name so", arguments.output,
                    arguments.animate ? "a film is a .gif or a .webm" : "a picture is a .png (a film: --animate)"));
}

void draw_one(ResultFolder& folder, const PictureArguments& arguments) {
  const std::size_t count = frames_to_draw(folder).size();
  if (arguments.frame && static_cast<std::size_t>(*arguments.frame) >= count)
    throw InputError(
        fmt::format("--frame {}: {} has the frames 0 to {}", *arguments.frame, arguments.directory, count - 1));
  const std::size_t frame = arguments.frame ? static_cast<std::size_t>(*arguments.frame) : count - 1;
  Pictures(folder, spec_of(arguments), {frame}).draw(frame, arguments.output);
}

void draw_film(ResultFolder& folder, const PictureArguments& arguments) {
  if (arguments.frame) throw InputError("--frame and --animate: a film is of all frames; leave one of the two");
  std::vector<std::size_t> frames(frames_to_draw(folder).size());
  std::iota(frames.begin(), frames.end(), std::size_t{0});
  Pictures pictures(folder, spec_of(arguments), frames);
  const PictureFolder scratch;
  for (const std::size_t frame : frames) pictures.draw(frame, scratch.path() / fmt::format("frame_{:04}.png", frame));
  const fs::path film = scratch.path() / ("film" + fs::path(arguments.output).extension().string());
  make_film(scratch.path() / "frame_%04d.png", film);
  write_text_whole(arguments.output, read_text_file(film));
}

void draw(const PictureArguments& arguments) {
  require_ending(arguments);
  ResultFolder folder(arguments.directory);
  require_writable(arguments.output, {}, arguments.force);
  arguments.animate ? draw_film(folder, arguments) : draw_one(folder, arguments);
  if (!arguments.quiet) log_line("drawn: " + arguments.output);
}

}  // namespace
}  // namespace weaveform

int main(int argc, char** argv) {
  weaveform::prepare_process();
  vtkObject::GlobalWarningDisplayOff();
  try {
    CLI::App program("The program that draws for 'weaveform render'", "weaveform-picture");
    weaveform::PictureArguments arguments;
    weaveform::add_picture_options(program, arguments);
    CLI11_PARSE(program, argc, argv);
    weaveform::draw(arguments);
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    return weaveform::report(error);
  }
}
