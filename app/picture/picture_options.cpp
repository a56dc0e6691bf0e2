#include "app/picture/picture_options.hpp"

#include "app/commands/commands.hpp"

namespace weaveform {

void add_picture_options(CLI::App& command, PictureArguments& arguments) {
  add_folder_argument(command, arguments.directory);
  command.add_option("-o,--output", arguments.output, "The picture (.png), or the film (.gif, .webm) with --animate")
      ->type_name("FILE")
      ->required();
  command.add_option("--field", arguments.field,
                     "Array of the frames that colours the fabric (default absolute_shear_angle_deg; docs/results.md)");
  command
      .add_option("--range", arguments.range, "Ends of the colours (default: those of the field over what is drawn)")
      ->expected(2)
      ->type_name("FROM TO");
  command.add_option("--view", arguments.view, "From where (default: a part at a slant, a flat blank from the top)")
      ->check(CLI::IsMember({"automatic", "top", "front", "side", "slant"}));
  command.add_option("--size", arguments.size, "Pixels (default 1200 900)")
      ->expected(2)
      ->check(CLI::Range(100, 8000))
      ->type_name("WIDTH HEIGHT");
  command.add_option("--frame", arguments.frame, "Number of the frame, from 0 (default: the last)")
      ->check(CLI::NonNegativeNumber);
  command.add_flag("--animate", arguments.animate, "A film of all frames, by ffmpeg");
  command.add_flag("--no-tools", arguments.without_tools, "The fabric alone");
  command.add_flag("--no-yarns", arguments.without_yarns, "The field without the lattice over it");
  add_force_argument(command, arguments.force);
  add_quiet_argument(command, arguments.quiet);
}

}  // namespace weaveform
