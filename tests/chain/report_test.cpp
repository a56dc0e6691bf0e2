// The report of a result and of a study, as its file says it; what a browser makes of it is in tests/report.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "post/post.hpp"
#include "post/report/part_json.hpp"
#include "tests/support/command_folder.hpp"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using weaveform::test::read_text;
using weaveform::test::says;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

template <class Number>
std::vector<Number> decoded(const std::string& text) {
  const auto value = [](char c) -> unsigned {
    if (c >= 'A' && c <= 'Z') return static_cast<unsigned>(c - 'A');
    if (c >= 'a' && c <= 'z') return static_cast<unsigned>(c - 'a') + 26U;
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0') + 52U;
    return c == '+' ? 62U : 63U;
  };
  std::vector<unsigned char> bytes;
  unsigned group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    group = (group << 6U | value(c)) & 0xffffffU;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<unsigned char>(group >> static_cast<unsigned>(bits) & 255U));
  }
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

class Report : public weaveform::test::CommandFolder {
protected:
  [[nodiscard]] json data(const std::string& page) const {
    const std::string text = read_text(file(page));
    const std::string begin = "id=\"weaveform-data\">";
    const std::size_t from = text.find(begin) + begin.size();
    return json::parse(text.substr(from, text.find("</script>", from) - from));
  }
  [[nodiscard]] static std::string row(const json& data, const std::string& name) {
    for (const auto& one : data["verdict"]["rows"])
      if (one["name"] == name) return one["value"];
    return "no row '" + name + "'";
  }
};

// Where the card lies means nothing to who reads the page.
TEST_F(Report, NamesTheCardAndNotItsPath) {
  const std::string cards = std::string(WEAVEFORM_SOURCE_DIR) + "/fabric/cards/";
  std::filesystem::create_directory(file("cards"));
  std::filesystem::copy_file(cards + "twintex-pw.toml", file("cards/mine.toml"));
  must("weaveform run tiny.toml --set fabric.material=cards/mine.toml --output done --report --quiet");
  const std::string subtitle = data("done/report.html")["subtitle"];
  EXPECT_EQ(subtitle.find('/'), std::string::npos) << subtitle;
  EXPECT_NE(subtitle.find("cells of twintex-pw, "), std::string::npos) << subtitle;
}

TEST_F(Report, SaysTheNumbersOfTheRunAndItsFields) {
  must("weaveform run tiny.toml --output done --report --quiet");
  const json page = data("done/report.html"), summary = json::parse(read_text(file("done/summary.json")));
  EXPECT_EQ(page["kind"], "result");
  const double greatest = summary["max_shear_angle_deg"];
  EXPECT_NEAR(std::stod(row(page, "greatest shear angle")), greatest, 0.05001);
  EXPECT_NEAR(std::stod(row(page, "force of top")), summary["grips"]["top"]["force_N"].get<double>(), 0.01);
  EXPECT_EQ(page["verdict"]["warnings"], summary["warnings"]);

  const json& part = page["part"];
  EXPECT_EQ(part["thinned"], "");
  const json& last = part["frames"].back();
  EXPECT_EQ(last["label"], "100 % of the way");
  const json& field = part["fields"][0];
  double most = 0.0;
  for (const auto value : decoded<std::uint16_t>(last["fields"]["shear_angle"]))
    most = std::max(most, field["from"].get<double>() +
                              (field["to"].get<double>() - field["from"].get<double>()) * value / 65534.0);
  EXPECT_NEAR(most, greatest, 1e-3);

  // nodes of the moved grip: the blank's upper edge, 30 mm further on
  double highest = -1e9;
  const auto numbers = decoded<std::int16_t>(last["position"]);
  EXPECT_EQ(numbers.size(), 3 * part["node_count"].get<std::size_t>());
  for (std::size_t k = 1; k < numbers.size(); k += 3)
    highest = std::max(
        highest, part["position"]["origin"][1].get<double>() + part["position"]["step"].get<double>() * numbers[k]);
  EXPECT_NEAR(highest, 115.0 + 30.0, 0.02);
  for (const auto node : decoded<std::uint32_t>(part["cells"]))
    EXPECT_LT(node, part["node_count"].get<std::uint32_t>());
}

TEST_F(Report, ChartsGoOverTheTravelInWords) {
  must("weaveform run tiny.toml --output done --quiet");
  must("weaveform post report done --quiet");
  const json page = data("done/report.html");
  for (const auto& chart : page["charts"]) {
    EXPECT_FALSE(says(chart["x"]["title"].get<std::string>(), "_")) << chart["x"]["title"];
    EXPECT_FALSE(says(chart["y"]["title"].get<std::string>(), "_")) << chart["y"]["title"];
    EXPECT_FALSE(chart["series"].empty()) << chart["id"];
    if (chart["id"] != "force") continue;
    EXPECT_NEAR(chart["series"][0]["x"].back().get<double>(), 30.0, 1e-9);
  }
}

TEST_F(Report, OfAnotherRunGoesWithIt) {
  must("weaveform run tiny.toml --output done --report --quiet");
  must("weaveform post done --quiet");
  EXPECT_TRUE(fs::exists(file("done/report.html"))) << "post makes nothing of it untrue";
  must("weaveform run tiny.toml --output done --quiet --set grip.top.travel=5");
  EXPECT_FALSE(fs::exists(file("done/report.html")));
}

TEST_F(Report, GoesWhereItIsToldAndLeavesOtherFilesAlone) {
  must("weaveform run tiny.toml --output done --quiet");
  must("weaveform post report done --output mine.html --quiet");
  must("weaveform post report done --output mine.html --quiet");
  write_text("mine", file("notes.html"));
  EXPECT_EQ(run("weaveform post report done --output notes.html").exit_code, 2);
  EXPECT_EQ(read_text(file("notes.html")), "mine");
  EXPECT_EQ(run("weaveform post report done --output done/mesh.vtu --force").exit_code, 2) << "an input";
  EXPECT_EQ(run("weaveform post report nowhere").exit_code, 4);
}

TEST_F(Report, OfAFormedPartHasToolsWrinklesAndDrawIn) {
  must("weaveform run '" WEAVEFORM_SOURCE_DIR
       "/examples/hemisphere_pw_fast.toml' --output part --set blank.coarsening=4 --report --quiet");
  const json page = data("part/report.html"), summary = json::parse(read_text(file("part/summary.json")));
  ASSERT_EQ(page["tools"].size(), 3U);
  for (const auto& tool : page["tools"]) {
    EXPECT_EQ(tool["motion"].size(), page["part"]["frames"].size());
    const std::string name = tool["name"].get<std::string>();
    const double way = name == "punch" ? 90.0
                       : name == "die" ? 0.0
                                       : summary["tools"][name]["displacement_mm"].get<double>();
    // frames hold single precision
    EXPECT_NEAR(std::abs(tool["motion"].back()[2].get<double>()), std::abs(way), 1e-5) << name;
    const std::size_t numbers = decoded<float>(tool["points"]).size();
    EXPECT_GT(numbers, 9U);
    for (const auto corner : decoded<std::uint32_t>(tool["triangles"])) EXPECT_LT(3 * corner, numbers);
  }
  EXPECT_NEAR(std::stod(row(page, "draw-in")), summary["forming"]["draw_in_mm"]["largest"].get<double>(), 0.01);
  std::vector<std::string> fields;
  for (const auto& field : page["part"]["fields"]) fields.push_back(field["name"]);
  for (const char* name : {"contact_pressure", "friction", "wrinkle_relief"})
    EXPECT_NE(std::find(fields.begin(), fields.end(), name), fields.end()) << name;
}

TEST_F(Report, ALargeOneIsThinnedAndSaysSo) {
  must(
      "weaveform run tiny.toml --output done --quiet --set output.frames=40 --set blank.coarsening=2 --set "
      "grip.top.travel=10");
  weaveform::ResultFolder folder(file("done"));
  const auto whole = weaveform::part_json(folder, {});
  EXPECT_EQ(whole.frames.size(), folder.frames().size());
  const auto end = weaveform::evaluate(folder).end.shear_angle;
  const auto most_sheared = static_cast<std::uint32_t>(
      std::max_element(end.begin(), end.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      end.begin());
  for (const std::size_t most : {150000U, 40000U}) {
    const auto page = weaveform::part_json(folder, {}, most);
    EXPECT_LT(page.json.dump().size(), most * 4 / 3 + 4000) << "base64 and names";
    EXPECT_TRUE(says(page.json["thinned"].get<std::string>(), "frames are shown")) << page.json["thinned"];
    EXPECT_GE(page.frames.size(), weaveform::least_frames);
    EXPECT_EQ(page.frames.front().time, folder.frames().front().time);
    EXPECT_EQ(page.frames.back().time, folder.frames().back().time);
    // the peak is not thinned away, and its cell can be found
    const auto numbers = decoded<std::uint32_t>(page.json["cell_numbers"]);
    EXPECT_NE(std::find(numbers.begin(), numbers.end(), most_sheared), numbers.end());
    EXPECT_NEAR(page.json["fields"][0]["to"].get<double>(), whole.json["fields"][0]["to"].get<double>(), 1e-9);
  }
}

TEST_F(Report, OfARunUnderWaySaysHowFarItCame) {
  must("weaveform run tiny.toml --output done --quiet");
  std::string statistics = read_text(file("done/solve.json"));
  statistics.replace(statistics.find("\"finished\": true"), 16, "\"finished\": false");
  write_text(statistics, file("done/solve.json"));
  must("weaveform post report done --quiet");
  EXPECT_TRUE(says(data("done/report.html")["verdict"]["warnings"].dump(), "not finished"));
}

TEST_F(Report, OfAStudyLeadsToItsCases) {
  write_text("scene = \"tiny.toml\"\nmeasures = [\"grips.top.force_N\"]\n[grid]\nblank.coarsening = [4, 3]\n",
             file("s.toml"));
  must("weaveform study s.toml --output out --quiet");
  EXPECT_TRUE(data("out/report.html")["tables"][0]["links"][0].is_null());
  must("weaveform study s.toml --output out --report --quiet");
  const json page = data("out/report.html");
  const json& table = page["tables"][0];
  ASSERT_EQ(table["rows"].size(), 2U);
  EXPECT_EQ(table["columns"].back(), "force of top at the end (N)");
  for (const auto& link : table["links"]) EXPECT_EQ(data("out/" + link.get<std::string>())["kind"], "result") << link;
  EXPECT_EQ(page["charts"].back()["x"]["title"], "cell size (mm)");
  EXPECT_TRUE(says(run("weaveform post report out"), "--report"));
}

}  // namespace
