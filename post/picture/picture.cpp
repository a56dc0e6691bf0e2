#include "post/picture/picture.hpp"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/keys/nearest_name.hpp"
#include "core/vector/vector.hpp"
#include "post/picture/palette.hpp"
#include "post/picture/sheet.hpp"
#include "post/picture/tool_surface.hpp"

namespace weaveform {
namespace {

constexpr std::size_t most_yarns_seen = 20000;  // beyond, lines lie on each other and hide the field
constexpr double nothing = 1e-6;                // of a field that is the same everywhere but for rounding
constexpr double flat_share = 0.02;             // of the extent: what rises less is looked at from above

vtkSmartPointer<vtkPoints> points_of(const std::vector<Vec3>& position) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(position.size()));
  for (std::size_t n = 0; n < position.size(); ++n) points->SetPoint(static_cast<vtkIdType>(n), position[n].data());
  return points;
}

vtkSmartPointer<vtkCellArray> polygons_of(const Sheet& sheet) {
  auto polygons = vtkSmartPointer<vtkCellArray>::New();
  for (const std::vector<int>& polygon : sheet.polygon) {
    polygons->InsertNextCell(static_cast<int>(polygon.size()));
    for (const int corner : polygon) polygons->InsertCellPoint(corner);
  }
  return polygons;
}

vtkSmartPointer<vtkCellArray> lines_of(const Sheet& sheet) {
  auto lines = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& [a, b] : sheet.yarn) {
    lines->InsertNextCell(2);
    lines->InsertCellPoint(a);
    lines->InsertCellPoint(b);
  }
  return lines;
}

struct Box {
  Vec3 low = {1e300, 1e300, 1e300}, high = {-1e300, -1e300, -1e300};
  void add(const Vec3& p) {
    for (std::size_t c = 0; c < 3; ++c) low[c] = std::min(low[c], p[c]), high[c] = std::max(high[c], p[c]);
  }
  [[nodiscard]] Vec3 middle() const { return scaled(plus(low, high), 0.5); }
  [[nodiscard]] double diagonal() const { return distance(low, high); }
};

// Way of looking and what is up then.
std::array<Vec3, 2> directions_of(View view) {
  switch (view) {
    case View::front:
      return {{{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    case View::side:
      return {{{-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}};
    case View::slant:
      return {{{-0.45, 0.65, -0.61}, {0.0, 0.0, 1.0}}};
    default:
      return {{{0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}}};
  }
}

vtkSmartPointer<vtkActor2D> flat_line(vtkPolyData& line) {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(&line);
  auto actor = vtkSmartPointer<vtkActor2D>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.1, 0.1, 0.1);
  actor->GetProperty()->SetLineWidth(3.0F);
  return actor;
}

// The greatest of 1, 2 and 5 times a power of ten that is no longer.
double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= length) return factor * power;
  return power;
}

}  // namespace

const std::vector<FieldTitle>& field_titles() {
  static const std::vector<FieldTitle> titles = {
      {"absolute_shear_angle_deg", "shear angle (°)", false, true},
      {"shear_angle_deg", "signed shear angle (°)", true, false},
      {"yarn_strain", "yarn strain (1)", true, false},
      {"yarn_force_N", "yarn force (N)", true, false},
      {"thickness_mm", "thickness (mm)", false, false},
      {"areal_weight_ratio", "areal weight over the flat fabric's (1)", false, false},
      {"contact_pressure_MPa", "contact pressure (MPa)", false, true},
      {"contact_share", "share of nodes in contact (1)", false, true},
      {"folded", "folded cells (1: folded)", false, true}};
  return titles;
}

struct Pictures::Stage {
  ResultFolder& folder;
  PictureSpec spec;
  const FieldTitle* title = nullptr;
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkPolyData> fabric, yarns;
  std::vector<vtkSmartPointer<vtkActor>> tool;
  vtkNew<vtkTextActor> caption;
  std::vector<FrameFile> frame_file;
  Resolved model;  // of the tools
  Box box;

  Stage(ResultFolder& result, PictureSpec asked)
      : folder(result), spec(std::move(asked)), frame_file(frames_to_draw(result)) {
    const auto& titles = field_titles();
    const auto found =
        std::find_if(titles.begin(), titles.end(), [&](const FieldTitle& t) { return spec.field == t.array; });
    if (found == titles.end()) {
      std::vector<std::string> names;
      for (const auto& one : titles) names.emplace_back(one.array);
      // the nearest name, or all of them
      throw InputError(fmt::format("no field '{}' to draw{}", spec.field, did_you_mean(spec.field, names)));
    }
    title = &*found;
  }

  [[nodiscard]] Sheet sheet(std::size_t frame) const { return read_sheet(frame_file[frame].file, spec.field); }

  // The box of all that will be drawn, and the colours' range where the user leaves it open.
  void look_at(const std::vector<std::size_t>& frames) {
    std::array<double, 2> range = {1e300, -1e300};
    for (const std::size_t frame : frames) {
      const Sheet drawn = sheet(frame);
      for (const Vec3& p : drawn.position) box.add(p);
      for (const double v : drawn.value)
        if (std::isfinite(v)) range = {std::min(range[0], v), std::max(range[1], v)};
    }
    if (!spec.range) spec.range = rounded_range(range);
  }

  // About zero, or from it, where the field asks for that; never without a width.
  [[nodiscard]] std::array<double, 2> rounded_range(std::array<double, 2> range) const {
    if (range[0] > range[1]) range = {0.0, 1.0};
    if (title->two_signs) {
      const double most = std::max({std::abs(range[0]), std::abs(range[1]), nothing});
      return {-most, most};
    }
    if (title->from_zero) range[0] = 0.0;
    if (range[1] - range[0] < nothing * std::max(1.0, std::abs(range[1]))) range[1] = range[0] + 1.0;
    return range;
  }

  void build(std::size_t first) {
    const Sheet topology = sheet(first);
    fabric->SetPolys(polygons_of(topology));
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(fabric);
    mapper->SetLookupTable(colours(title->two_signs ? Palette::two_signs : Palette::one_sign, *spec.range));
    mapper->SetScalarModeToUseCellData();
    mapper->UseLookupTableScalarRangeOn();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetInterpolationToFlat();
    actor->GetProperty()->SetAmbient(0.45);
    actor->GetProperty()->SetDiffuse(0.6);
    renderer->AddActor(actor);
    add_colour_bar(*mapper);
    if (spec.yarns && topology.yarn.size() <= most_yarns_seen) add_yarns(topology);
    if (spec.tools) add_tools();
    renderer->SetBackground(1.0, 1.0, 1.0);
    renderer->UseDepthPeelingOn();
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetAlphaBitPlanes(1);
    window->SetSize(spec.size[0], spec.size[1]);
    window->AddRenderer(renderer);
    place_camera();
    add_scale();
    add_caption();
  }

  void add_colour_bar(vtkPolyDataMapper& mapper) const {
    vtkNew<vtkScalarBarActor> bar;
    bar->SetLookupTable(mapper.GetLookupTable());
    bar->SetTitle(title->title);
    bar->SetNumberOfLabels(6);
    bar->SetLabelFormat("%-#.3g");
    bar->UnconstrainedFontSizeOn();
    bar->SetVerticalTitleSeparation(spec.size[1] / 50);
    bar->SetPosition(0.88, 0.18);
    bar->SetWidth(0.08);
    bar->SetHeight(0.64);
    for (vtkTextProperty* text : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()}) set_text(*text);
    renderer->AddActor2D(bar);
  }

  void set_text(vtkTextProperty& text) const {
    text.SetColor(0.1, 0.1, 0.1);
    text.SetFontFamilyToArial();
    text.SetFontSize(std::max(10, spec.size[1] / 45));
    text.ItalicOff();
    text.BoldOff();
    text.ShadowOff();
  }

  void add_yarns(const Sheet& topology) const {
    yarns->SetLines(lines_of(topology));
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(yarns);
    mapper->ScalarVisibilityOff();
    mapper->SetResolveCoincidentTopologyToPolygonOffset();
    mapper->SetRelativeCoincidentTopologyLineOffsetParameters(-2.0, -2.0);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(0.15, 0.15, 0.15);
    actor->GetProperty()->SetOpacity(0.35);
    actor->GetProperty()->LightingOff();
    renderer->AddActor(actor);
  }

  void add_tools() {
    model = model_to_draw(folder);
    if (model.tools.empty()) return;
    const auto near = tools_near(model, tools_moved(folder, model, frame_file.back().time), box.low, box.high);
    for (const vtkSmartPointer<vtkPolyData>& surface : tool_surfaces(near)) {
      vtkNew<vtkPolyDataMapper> mapper;
      mapper->SetInputData(surface);
      auto actor = vtkSmartPointer<vtkActor>::New();
      actor->SetMapper(mapper);
      actor->GetProperty()->SetColor(0.55, 0.62, 0.70);
      actor->GetProperty()->SetOpacity(0.16);
      renderer->AddActor(actor);
      tool.push_back(actor);
    }
  }

  // Along the view, and near enough that fabric of all frames fills the picture.
  void place_camera() {
    View view = spec.view;
    if (view == View::automatic)
      view = box.high[2] - box.low[2] > flat_share * box.diagonal() ? View::slant : View::top;
    const auto [along, up] = directions_of(view);
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    const Vec3 middle = box.middle(), eye = plus(middle, scaled(along, -2.0 * box.diagonal()));
    camera->SetFocalPoint(middle.data());
    camera->SetPosition(eye.data());
    camera->SetViewUp(up.data());
    double half_width = 0.0, half_height = 0.0;
    const Vec3 right = unit_of(cross(along, up)), above = cross(right, unit_of(along));
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p = minus({(corner & 1) != 0 ? box.high[0] : box.low[0], (corner & 2) != 0 ? box.high[1] : box.low[1],
                            (corner & 4) != 0 ? box.high[2] : box.low[2]},
                           middle);
      half_width = std::max(half_width, std::abs(dot(p, right)));
      half_height = std::max(half_height, std::abs(dot(p, above)));
    }
    const double aspect = static_cast<double>(spec.size[0]) / spec.size[1];
    // the colour bar takes an eighth at the right, caption and scale a tenth at top and bottom
    camera->SetParallelScale(std::max(half_height / 0.8, half_width / (0.76 * aspect)));
    camera->SetWindowCenter(0.1, 0.0);
    renderer->ResetCameraClippingRange();
  }

  static Vec3 unit_of(const Vec3& a) { return scaled(a, 1.0 / length(a)); }

  // A bar of a round length with the length beside it; in the picture's plane, so that it holds everywhere.
  void add_scale() {
    const double pixels_per_mm = 0.5 * spec.size[1] / renderer->GetActiveCamera()->GetParallelScale();
    const double mm = round_length(0.25 * spec.size[0] / pixels_per_mm);
    const double x = 0.03 * spec.size[0], y = 0.045 * spec.size[1], wide = mm * pixels_per_mm;
    vtkNew<vtkPoints> ends;
    ends->InsertNextPoint(x, y, 0.0);
    ends->InsertNextPoint(x + wide, y, 0.0);
    vtkNew<vtkCellArray> line;
    line->InsertNextCell({0, 1});
    vtkNew<vtkPolyData> bar;
    bar->SetPoints(ends);
    bar->SetLines(line);
    renderer->AddActor2D(flat_line(*bar));
    vtkNew<vtkTextActor> text;
    text->SetInput(fmt::format("{:g} mm", mm).c_str());
    text->SetDisplayPosition(static_cast<int>(x), static_cast<int>(y + 0.01 * spec.size[1]));
    set_text(*text->GetTextProperty());
    renderer->AddActor2D(text);
  }

  void add_caption() {
    set_text(*caption->GetTextProperty());
    caption->SetDisplayPosition(static_cast<int>(0.03 * spec.size[0]), static_cast<int>(0.95 * spec.size[1]));
    renderer->AddActor2D(caption);
  }

  void show(std::size_t frame) {
    const double time = frame_file[frame].time, end = frame_file.back().time;
    const Sheet drawn = sheet(frame);
    const auto points = points_of(drawn.position);
    fabric->SetPoints(points);
    yarns->SetPoints(points);
    vtkNew<vtkDoubleArray> scalars;
    scalars->SetName(spec.field.c_str());
    scalars->SetNumberOfTuples(static_cast<vtkIdType>(drawn.value.size()));
    std::copy(drawn.value.begin(), drawn.value.end(), scalars->GetPointer(0));
    fabric->GetCellData()->SetScalars(scalars);
    fabric->Modified();
    yarns->Modified();
    if (!tool.empty()) {
      std::vector<Vec3> moved = tools_moved(folder, model, time);
      for (std::size_t t = 0; t < tool.size(); ++t) tool[t]->SetPosition(moved[t].data());
    }
    const std::string name = std::filesystem::weakly_canonical(folder.directory()).filename().string();
    caption->SetInput((end > 0.0 ? fmt::format("{}, {:.0f} % of the way", name, 100.0 * time / end) : name).c_str());
    renderer->ResetCameraClippingRange();
  }
};

Pictures::Pictures(ResultFolder& folder, PictureSpec spec, const std::vector<std::size_t>& frames)
    : stage_(std::make_unique<Stage>(folder, std::move(spec))) {
  stage_->look_at(frames);
  stage_->build(frames.front());
}

Pictures::~Pictures() = default;

void Pictures::draw(std::size_t frame, const std::filesystem::path& file) {
  stage_->show(frame);
  stage_->window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(stage_->window);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  if (bytes == nullptr || bytes->GetNumberOfValues() == 0)
    throw FileError(fmt::format("{}: nothing could be drawn; is the screen (DISPLAY) there?", file.string()));
  const auto* first = reinterpret_cast<const char*>(bytes->GetPointer(0));
  write_text_whole(file, std::string(first, static_cast<std::size_t>(bytes->GetNumberOfValues())));
}

}  // namespace weaveform
