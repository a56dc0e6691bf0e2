#include "app/manual_page.hpp"

#include <fmt/format.h>

#include "core/version/version.hpp"

namespace weaveform {
namespace {

// Text of the page: no character of it is taken as a request.
std::string escaped(const std::string& text) {
  std::string out;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    at_start = c == '\n';
  }
  return out;
}

std::string heading_of(const CommandOption& option) {
  std::string heading;
  for (const std::string& name : option.names)
    heading += fmt::format("{}\\fB{}\\fR", heading.empty() ? "" : ", ", escaped(name));
  if (!option.value.empty()) heading += fmt::format(" \\fI{}\\fR", escaped(option.value));
  return heading;
}

std::string entry_of(const CommandOption& option) {
  std::string text = option.description;
  if (!option.choices.empty()) text += fmt::format(" One of: {}.", fmt::join(option.choices, ", "));
  return fmt::format(".TP\n{}\n{}\n", heading_of(option), escaped(text));
}

std::string section_of(const Command& command) {
  std::string synopsis = fmt::format("\\fBweaveform {}\\fR", command.path);
  for (const CommandOption& option : command.options)
    if (option.is_positional)
      synopsis += fmt::format(" {}\\fI{}\\fR{}", option.is_required ? "" : "[", escaped(option.names[0]),
                              option.is_required ? "" : "]");
  std::string section =
      fmt::format(".SS {0}\n{1} [\\fIOPTIONS\\fR]\n.PP\n{2}.\n", command.path, synopsis, escaped(command.description));
  for (const CommandOption& option : command.options) section += entry_of(option);
  return section;
}

constexpr const char* page_ending = R"(.SH EXIT STATUS
.TP
.B 0
done
.TP
.B 2
the input is wrong: scene, card, arguments
.TP
.B 3
the physics failed: unstable, tangled, energy balance lost
.TP
.B 4
files: missing, unreadable, no permission, disk full; also no memory left
.TP
.B 130
stopped by a signal, with a checkpoint left behind
.TP
.B 1
a defect in Weaveform itself: please report it
.SH ENVIRONMENT
.TP
.B WEAVEFORM_INSTRUCTIONS
sse2, avx2 or avx512: the inner loops use this instruction set instead of the processor's widest, as \fBweaveform
\-\-version\fR then says. Results differ in the last bits from set to set.
.SH EXAMPLES
.nf
weaveform run scene.toml \-\-output out
weaveform check scene.toml \-\-set grip.top.travel=20
.fi
)";

}  // namespace

std::string manual_page(const std::vector<Command>& tree) {
  const std::string line = version_line();
  std::string page = fmt::format(".TH WEAVEFORM 1 \"\" \"{}\" \"User Commands\"\n", line.substr(0, line.find(" (")));
  page += ".SH NAME\nweaveform \\- how woven reinforcements form\n";
  page += ".SH SYNOPSIS\n\\fBweaveform\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n";
  page += fmt::format(".SH DESCRIPTION\n{}\n", escaped(tree.front().description));
  for (const CommandOption& option : tree.front().options) page += entry_of(option);
  page += ".SH COMMANDS\n";
  for (std::size_t c = 1; c < tree.size(); ++c) page += section_of(tree[c]);
  return page + page_ending;
}

}  // namespace weaveform
