// Pictures and films of a result, as `weaveform render` leaves them: size, colours, frames, and what it says when it cannot.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <array>
#include <set>
#include <string>

#include "tests/support/command_folder.hpp"

namespace {

using weaveform::test::CommandResult;
using weaveform::test::read_text;
using weaveform::test::says;

struct Image {
  std::array<int, 3> size = {0, 0, 0};
  std::set<std::array<int, 3>> colours;
  // Whether some pixel is within 40 of 255 of it, as light and shade leave it.
  [[nodiscard]] bool shows(const std::array<int, 3>& wanted) const {
    for (const auto& colour : colours) {
      int most = 0;
      for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(colour[c] - wanted[c]));
      if (most <= 40) return true;
    }
    return false;
  }
};

class Render : public weaveform::test::CommandFolder {
protected:
  void SetUp() override {
    CommandFolder::SetUp();
    if (run("command -v xvfb-run").exit_code != 0) GTEST_SKIP() << "xvfb is not installed";
    must("weaveform run tiny.toml --output done --quiet");
  }

  [[nodiscard]] Image image(const std::string& name) const {
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(file(name).c_str());
    reader->Update();
    Image read;
    reader->GetOutput()->GetDimensions(read.size.data());
    for (int y = 0; y < read.size[1]; ++y)
      for (int x = 0; x < read.size[0]; ++x) {
        const auto* p = static_cast<const unsigned char*>(reader->GetOutput()->GetScalarPointer(x, y, 0));
        read.colours.insert({p[0], p[1], p[2]});
      }
    return read;
  }
};

constexpr std::array<int, 3> bright = {253, 231, 37}, dark = {68, 1, 84};  // ends of viridis

TEST_F(Render, APictureHasTheSizeAndTheColoursOfItsField) {
  must("weaveform render done --output last.png --size 400 300");
  const Image last = image("last.png");
  EXPECT_EQ(last.size[0], 400);
  EXPECT_EQ(last.size[1], 300);
  EXPECT_TRUE(last.shows(bright));
  EXPECT_TRUE(last.shows({255, 255, 255}));
  must("weaveform render done --output first.png --size 400 300 --frame 0 --range 0 50");
  EXPECT_FALSE(image("first.png").colours == last.colours);
}

// The same result on colours that go ten times as far: the fabric is dark; the bright end stays in the colour bar alone.
TEST_F(Render, TheRangeSetsTheColours) {
  must("weaveform render done --output near.png --size 400 300 --no-yarns");
  must("weaveform render done --output far.png --size 400 300 --no-yarns --range 0 1000");
  EXPECT_TRUE(image("far.png").shows(dark));
  EXPECT_NE(read_text(file("near.png")), read_text(file("far.png")));
}

TEST_F(Render, TheSameCommandDrawsTheSameBytes) {
  must("weaveform render done --output a.png --size 300 200");
  must("weaveform render done --output b.png --size 300 200");
  EXPECT_EQ(read_text(file("a.png")), read_text(file("b.png")));
}

TEST_F(Render, AFilmHasEveryFrame) {
  if (run("command -v ffprobe").exit_code != 0) GTEST_SKIP() << "ffmpeg is not installed";
  for (const std::string film : {"film.gif", "film.webm"}) {
    must("weaveform render done --output " + film + " --animate --size 320 240");
    const CommandResult count =
        run("ffprobe -v error -count_frames -select_streams v -show_entries stream=nb_read_frames -of csv=p=0 " + film);
    EXPECT_EQ(std::stoi(count.out), std::stoi(run("ls done/frames | wc -l").out)) << film;
  }
}

TEST_F(Render, ADrapeIsDrawnOnItsTool) {
  must("weaveform drape '" WEAVEFORM_SOURCE_DIR "/examples/drape_hemisphere.toml' --output net --quiet");
  must("weaveform render net --output net.png --size 400 300 --quiet");
  EXPECT_TRUE(image("net.png").shows(bright));
  EXPECT_TRUE(image("net.png").shows(dark));
  EXPECT_TRUE(says(run("weaveform render net --output no.png --field thickness_mm"), "thickness_mm"));
}

TEST_F(Render, SaysWhatItCannotDraw) {
  const CommandResult field = run("weaveform render done --output x.png --field shear_angel_deg");
  EXPECT_EQ(field.exit_code, 2);
  EXPECT_TRUE(says(field, "shear_angle_deg")) << field.err;
  const CommandResult none = run("weaveform render done --output x.png --field qqqqqqqqqqqqqqqq");
  const std::size_t first = none.err.find("thickness_mm");
  ASSERT_NE(first, std::string::npos) << none.err;
  EXPECT_EQ(none.err.find("thickness_mm", first + 1), std::string::npos) << "listed once: " << none.err;
  const CommandResult frame = run("weaveform render done --output x.png --frame 999");
  EXPECT_EQ(frame.exit_code, 2);
  EXPECT_TRUE(says(frame, "has the frames 0 to")) << frame.err;
  EXPECT_EQ(run("weaveform render done --output x.jpg").exit_code, 2);
  EXPECT_EQ(run("weaveform render nowhere --output x.png").exit_code, 4);
  const CommandResult screen = run("unset DISPLAY; PATH=/nowhere weaveform render done --output x.png");
  EXPECT_EQ(screen.exit_code, 4);
  EXPECT_TRUE(says(screen, "apt-get install xvfb")) << screen.err;
}

}  // namespace
