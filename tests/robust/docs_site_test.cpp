// The documents as a site (./dev site): its links and anchors lead somewhere, charts and sources are on it, and a broken one
// ends the build. Skipped without MkDocs and its Material theme.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/run_command.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::read_text;
using weaveform::test::run_command;
using weaveform::test::says;
using weaveform::test::TemporaryFolder;
using weaveform::test::write_text;

const fs::path source_dir = WEAVEFORM_SOURCE_DIR;

// Builds the site of the project in `root` into `folder`/site.
weaveform::test::CommandResult build_site(const fs::path& root, const fs::path& folder) {
  return run_command("PYTHONDONTWRITEBYTECODE=1 mkdocs build --strict --config-file '" +
                         (root / "mkdocs.yml").string() + "' --site-dir '" + (folder / "site").string() + "'",
                     folder);
}

class DocsSite : public testing::Test {
protected:
  void SetUp() override {
    const auto has = run_command("command -v mkdocs && test -d /usr/share/mkdocs/themes/material", folder_.path());
    if (has.exit_code != 0) GTEST_SKIP() << "mkdocs and mkdocs-material are not installed";
  }

  // A project of two pages, a scene and a folder, all of whose links lead somewhere.
  fs::path small_project() const {
    const fs::path root = folder_.path() / "project";
    fs::create_directories(root / "docs");
    fs::create_directories(root / "examples" / "parts");
    fs::copy(source_dir / "mkdocs.yml", root / "mkdocs.yml");
    fs::copy(source_dir / "docs" / "site", root / "docs" / "site", fs::copy_options::recursive);
    write_text("# Project\n\n[order](docs/README.md), [scene](examples/a.toml)\n", root / "README.md");
    write_text("# Order\n\n## First\n\n- [page](page.md)\n", root / "docs" / "README.md");
    write_text("# Page\n\n## Of `two` words\n\n[up](../README.md#project), [parts](../examples/parts)\n",
               root / "docs" / "page.md");
    write_text("# Changes\n", root / "CHANGELOG.md");
    write_text("key = \"value of a scene\"\n", root / "examples" / "a.toml");
    write_text("SetFactory(\"OpenCASCADE\");\n", root / "examples" / "parts" / "box.geo");
    return root;
  }

  TemporaryFolder folder_;
};

TEST_F(DocsSite, OfThisProjectHasNoBrokenLink) {
  const auto result = build_site(source_dir, folder_.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const fs::path site = folder_.path() / "site";
  EXPECT_TRUE(says(result.err, " links looked at, 0 broken")) << result.err;
  EXPECT_TRUE(fs::exists(site / "index.html"));
  EXPECT_TRUE(fs::exists(site / "search" / "offline.js")) << "the search of pages opened from the disk";
  EXPECT_TRUE(says(read_text(site / "docs" / "accuracy.html"), "accuracy/hemisphere_tools.punch.force_N.svg"));
  EXPECT_TRUE(fs::exists(site / "docs" / "accuracy" / "hemisphere_tools.punch.force_N.svg"));
  EXPECT_TRUE(says(read_text(site / "examples" / "hemisphere_pw.toml.html"), "opening_radius"));
}

TEST_F(DocsSite, ShowsSourcesAndFoldersThatPagesLinkTo) {
  const auto result = build_site(small_project(), folder_.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const fs::path site = folder_.path() / "site";
  EXPECT_TRUE(says(read_text(site / "index.html"), "href=\"examples/a.toml.html\""));
  EXPECT_TRUE(says(read_text(site / "examples" / "a.toml.html"), "value of a scene"));
  EXPECT_TRUE(says(read_text(site / "docs" / "page.html"), "href=\"../examples/parts/index.html\""));
  EXPECT_TRUE(says(read_text(site / "examples" / "parts" / "index.html"), "href=\"box.geo.html\""));
  EXPECT_TRUE(says(read_text(site / "docs" / "page.html"), "id=\"of-two-words\"")) << "the forge's anchors";
}

// Each alone, so that none hides behind another.
TEST_F(DocsSite, EndsWithAnErrorThatNamesTheBrokenLink) {
  const struct {
    std::string link, told;
  } cases[] = {
      {"[a](missing.md)", "missing.md"},
      {"[a](../examples/missing.toml)", "../examples/missing.toml"},
      {"[a](../examples/missing)", "../examples/missing"},
      {"[a](#of-three-words)", "#of-three-words leads to no such anchor; the nearest is #of-two-words"},
      {"[a](README.md#second)", "#second leads to no such anchor"},
      {"![a](missing.svg)", "missing.svg"},
      {"[a](../../outside)", "../../outside"},
      {"<img src=\"missing.png\">", "missing.png"},
      {"<img src=\"https://example.org/a.png\">", "https://example.org/a.png is loaded over the network"},
  };
  const fs::path root = small_project();
  const std::string page = read_text(root / "docs" / "page.md");
  for (const auto& broken : cases) {
    write_text(page + "\n" + broken.link + "\n", root / "docs" / "page.md");
    const auto result = build_site(root, folder_.path());
    EXPECT_EQ(result.exit_code, 1) << broken.link << "\n" << result.err;
    EXPECT_TRUE(says(result.err, broken.told)) << broken.link << "\n" << result.err;
  }
}

TEST_F(DocsSite, EndsWithAnErrorWhenADocumentIsNotInTheReadingOrder) {
  const fs::path root = small_project();
  write_text("# Nobody finds me\n", root / "docs" / "lost.md");
  const auto result = build_site(root, folder_.path());
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_TRUE(says(result.err, "docs/README.md does not name docs/lost.md")) << result.err;
}

// What stands in code is shown, not followed.
TEST_F(DocsSite, LeavesLinksInCodeAlone) {
  const fs::path root = small_project();
  write_text(read_text(root / "docs" / "page.md") + "\n```text\n[a](missing.md)\n```\n\n`[b](gone.md)`\n",
             root / "docs" / "page.md");
  const auto result = build_site(root, folder_.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

}  // namespace
