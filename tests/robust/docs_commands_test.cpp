// What the documents say is run: every line of a ```sh block in README.md and docs/*.md that calls weaveform must exit
// with 0, or with the code its trailing comment names ("# exit 2"). "# not run" at the end of a line leaves it out. All
// lines of one document run in order in one folder, in which `examples` is the project's. Lines calling ./dev are only
// checked for the command's existence, for they would build and test all over again. The tutorial's lines are run, and what
// they print compared, by Tutorial.SaysWhatComesOut; here only under the sanitizers, which leave that test out.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/scene/reader.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/run_command.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::read_text;
using weaveform::test::run_command;
using weaveform::test::TemporaryFolder;

struct DocLine {
  int number = 0;
  std::string command;
  int exit_code = 0;
  bool left_out = false;
};

std::vector<fs::path> documents() {
  const fs::path root = WEAVEFORM_SOURCE_DIR;
  std::vector<fs::path> found = {root / "README.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md" && (weaveform::test::instrumented || entry.path().stem() != "tutorial"))
      found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

DocLine parsed(int number, const std::string& line) {
  static const std::regex expected_exit(R"(#.*\bexit (\d+))");
  static const std::regex left_out(R"(#.*\bnot run\b)");
  std::smatch match;
  DocLine result{number, line, 0, std::regex_search(line, left_out)};
  if (std::regex_search(line, match, expected_exit)) result.exit_code = std::stoi(match[1].str());
  return result;
}

// Lines of the document's sh blocks, with lines continued by a backslash joined.
std::vector<DocLine> shell_lines(const fs::path& document) {
  std::ifstream file(document);
  std::vector<DocLine> lines;
  std::string joined;
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.starts_with("```")) {
      inside = line == "```sh";
      continue;
    }
    if (!inside) continue;
    joined += line;
    if (joined.ends_with('\\')) {
      joined.back() = ' ';
      continue;
    }
    if (!joined.empty()) lines.push_back(parsed(number, joined));
    joined.clear();
  }
  return lines;
}

// "weaveform ..." when the line calls the program by either of its names, else "".
std::string program_call(const std::string& line) {
  static const std::regex twice(R"(coarsening=2\b)");
  for (const std::string name : {"build/bin/weaveform ", "weaveform "}) {
    if (!line.starts_with(name)) continue;
    const std::string call = "weaveform " + line.substr(name.size());
    const bool takes_coarser = weaveform::test::instrumented && !weaveform::test::says(call, "--accuracy");
    return takes_coarser ? std::regex_replace(call, twice, "coarsening=4") : call;
  }
  return "";
}

// The project's examples; every fourth yarn of each scene's where that would take hours.
void give_examples(const fs::path& folder) {
  const fs::path examples = fs::path(WEAVEFORM_SOURCE_DIR) / "examples";
  if (!weaveform::test::instrumented) {
    fs::create_directory_symlink(examples, folder / "examples");
    return;
  }
  fs::copy(examples, folder / "examples", fs::copy_options::recursive);
  static const std::regex blank(R"(\n\[blank\]\n)"), coarsening(R"(\ncoarsening = [^\n]*)");
  static const std::regex levels(R"((\n"?blank\.coarsening"? = )\[8, [^\]]*\])");  // of a study
  for (const auto& entry : fs::recursive_directory_iterator(folder / "examples")) {
    if (entry.path().extension() != ".toml" || entry.path().stem() == "cantilever_pw")
      continue;  // a strip of few yarns
    std::string text = std::regex_replace("\n" + read_text(entry.path()), coarsening, "");
    text = std::regex_replace(text, levels, "$1[8, 6, 4]");
    weaveform::test::write_text(std::regex_replace(text, blank, "\n[blank]\ncoarsening = 4\n"), entry.path());
  }
}

class Document : public testing::TestWithParam<fs::path> {};

TEST_P(Document, CommandsExitAsItSays) {
  const TemporaryFolder folder;
  give_examples(folder.path());
  for (const auto& line : shell_lines(GetParam())) {
    const std::string call = program_call(line.command);
    if (call.empty() || line.left_out) continue;
    const auto result = run_command(call, folder.path());
    EXPECT_EQ(result.exit_code, line.exit_code)
        << GetParam().filename().string() << ":" << line.number << ": " << line.command << "\n"
        << result.err;
  }
}

TEST_P(Document, DevCommandsExist) {
  const auto help = run_command("'" WEAVEFORM_SOURCE_DIR "/dev' help", "/");
  ASSERT_EQ(help.exit_code, 0) << help.err;
  static const std::regex call(R"(^\./dev (\w+))");
  for (const auto& line : shell_lines(GetParam())) {
    std::smatch match;
    if (!std::regex_search(line.command, match, call)) continue;
    EXPECT_NE(help.out.find("\n  " + match[1].str() + " "), std::string::npos)
        << GetParam().filename().string() << ":" << line.number << ": ./dev help does not list " << match[1].str();
  }
}

// A document's only links into the project that can rot are relative ones.
TEST_P(Document, RelativeLinksLeadSomewhere) {
  static const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
  const std::string text = read_text(GetParam());
  for (std::sregex_iterator match(text.begin(), text.end(), link), end; match != end; ++match)
    EXPECT_TRUE(fs::exists(GetParam().parent_path() / (*match)[1].str()))
        << GetParam().filename().string() << " links to " << (*match)[1].str();
}

INSTANTIATE_TEST_SUITE_P(Docs, Document, testing::ValuesIn(documents()), [](const auto& instance) {
  // docs/README.md beside README.md
  const bool second_of_its_name = instance.param.stem() == "README" && instance.param.parent_path().stem() == "docs";
  std::string name = (second_of_its_name ? "docs_" : "") + instance.param.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

TEST(SceneReference, IsTheOneTheProgramPrints) {
  EXPECT_EQ(read_text(fs::path(WEAVEFORM_SOURCE_DIR) / "docs" / "scene.md"), weaveform::scene_reference_markdown())
      << "docs/scene.md is generated: run ./dev docs";
}

TEST(CardReference, IsTheOneTheProgramPrints) {
  EXPECT_EQ(read_text(fs::path(WEAVEFORM_SOURCE_DIR) / "docs" / "card.md"), weaveform::card_reference_markdown())
      << "docs/card.md is generated: run ./dev docs";
}

TEST(ReadingOrder, NamesEveryDocument) {
  const std::string order = read_text(fs::path(WEAVEFORM_SOURCE_DIR) / "docs" / "README.md");
  for (const auto& document : documents()) {
    const std::string name = document.filename().string();
    EXPECT_NE(order.find("](" + std::string(name == "README.md" ? "../" : "") + name + ")"), std::string::npos)
        << "docs/README.md does not say for whom and what for " << name << " is";
  }
}

TEST(Readme, ShowsTheTwoCommands) {
  const auto lines = shell_lines(fs::path(WEAVEFORM_SOURCE_DIR) / "README.md");
  const auto has = [&](const std::string& command) {
    return std::any_of(lines.begin(), lines.end(), [&](const auto& line) { return line.command.starts_with(command); });
  };
  EXPECT_TRUE(has("./dev run"));
  EXPECT_TRUE(has("./dev test"));
}

}  // namespace
