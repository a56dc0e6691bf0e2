// Weaveform as others use it: installed, found by find_package, linked, and run in the program that docs/library.md shows.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "mesher/tools/cad.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/run_command.hpp"

namespace {

using weaveform::test::CommandResult;
using weaveform::test::read_text;
using weaveform::test::run_command;
using weaveform::test::TemporaryFolder;
using weaveform::test::write_text;

// The first block of the document in this language.
std::string block_of(const std::string& text, const std::string& language) {
  const std::string fence = "\n```" + language + "\n";
  const std::size_t begin = text.find(fence);
  if (begin == std::string::npos) return "";
  const std::size_t start = begin + fence.size();
  return text.substr(start, text.find("```", start) - start);
}

// Reads CAD, for which a module must be found that lies with the libraries (mesher/tools/opencascade.hpp).
constexpr const char* reader = R"(
#include <iostream>

#include "mesher/tools/cad.hpp"

int main(int, char** words) {
  try {
    std::cout << weaveform::read_cad(words[1], 0.1).list.triangle.size() << '\n';
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
})";

TEST(Consumer, BuildsAndRunsTheProgramOfTheDocumentsAndReadsCad) {
  const TemporaryFolder folder;
  const std::string document = read_text(WEAVEFORM_SOURCE_DIR "/docs/library.md");
  write_text(block_of(document, "cmake") +
                 "add_executable(read read.cpp)\n"
                 "target_compile_features(read PRIVATE cxx_std_20)\n"
                 "target_link_libraries(read PRIVATE Weaveform::mesher)\n",
             folder.path() / "CMakeLists.txt");
  write_text(reader, folder.path() / "read.cpp");
  write_text(block_of(document, "cpp"), folder.path() / "pull.cpp");
  const auto must = [&](const std::string& command) {
    const CommandResult result = run_command(command, folder.path());
    EXPECT_EQ(result.exit_code, 0) << command << '\n' << result.out << result.err;
    return result.out;
  };
  must("cmake --install '" WEAVEFORM_BUILD_DIR "' --prefix \"$PWD/prefix\" --component development");
  must("cmake -G Ninja -B build -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER='" WEAVEFORM_COMPILER
       "' -DCMAKE_PREFIX_PATH=\"$PWD/prefix\" && cmake --build build");
  const std::string block = WEAVEFORM_SOURCE_DIR "/tests/data/cad/block_mm.igs";
  // the address sanitizer loads in our place, and its RUNPATH is not ours
  const std::string place = weaveform::test::instrumented ? "LD_LIBRARY_PATH=\"$PWD/prefix/libexec/weaveform\" " : "";
  EXPECT_EQ(must(place + "build/read '" + block + "'"),
            std::to_string(weaveform::read_cad(block, 0.1).list.triangle.size()) + "\n");
  const std::string said = must("build/pull '" WEAVEFORM_SOURCE_DIR "/examples/bias_extension_pw.toml'");
  // the load as the program itself has it, of the same bits
  must("weaveform run '" WEAVEFORM_SOURCE_DIR
       "/examples/bias_extension_pw.toml' --quiet --output out --set blank.coarsening=5 --set grip.top.travel=5");
  double cells = 0, load = 0;
  std::string word;
  std::istringstream(said) >> cells >> word >> load;
  EXPECT_EQ(cells, nlohmann::json::parse(read_text(folder.path() / "out/solve.json")).at("cells").get<int>()) << said;
  const std::string history = read_text(folder.path() / "out/history.csv");
  const std::string heading = history.substr(0, history.find('\n'));
  const std::string last = history.substr(history.rfind('\n', history.size() - 2) + 1);
  std::istringstream names(heading), values(last);
  double expected = 0;
  for (std::string name, value; std::getline(names, name, ',') && std::getline(values, value, ',');)
    if (name == "top.force_N") expected = std::stod(value);
  EXPECT_NEAR(load, expected, 1e-5 * std::abs(expected)) << said;
  EXPECT_GT(expected, 0.0);
}

}  // namespace
