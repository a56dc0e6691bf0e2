// The frame writer: one grid, whose topology is built once and whose arrays are refilled for each frame.
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSignedCharArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/vector/angle.hpp"
#include "mesher/mesh/stack.hpp"
#include "mesher/mesh/vtk_file.hpp"
#include "solver/result/beside.hpp"
#include "solver/result/file_names.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

std::string frame_name(std::size_t number) {
  return fmt::format("{}/frame_{:04d}.vtu", file_name::frames, number);
}

template <class Array>
Array* add_array(vtkFieldData& data, const char* name, int components, vtkIdType tuples) {
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->Fill(0.0);
  data.AddArray(array);
  return array;  // kept alive by `data`
}

int polygon_type(int nodes) {
  return nodes == 3 ? VTK_TRIANGLE : nodes == 4 ? VTK_QUAD : VTK_POLYGON;
}

// Lines first, then polygons, each in the mesh's order.
void set_topology(vtkUnstructuredGrid& grid, const Mesh& mesh) {
  const vtkIdType count = mesh.yarn_count() + mesh.cells.size();
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfTuples(count);
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(count, 2 * mesh.yarn_count() + static_cast<vtkIdType>(mesh.cells.node.size()));
  vtkIdType next = 0;
  for (const auto& [a, b] : mesh.yarns.node) {
    const vtkIdType ends[2] = {a, b};
    cells->InsertNextCell(2, ends);
    types->SetValue(next++, VTK_LINE);
  }
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const int begin = mesh.cells.offset[cell], nodes = mesh.cells.offset[cell + 1] - begin;
    cells->InsertNextCell(nodes);
    for (int k = 0; k < nodes; ++k) cells->InsertCellPoint(mesh.cells.node[begin + k]);
    types->SetValue(next++, static_cast<unsigned char>(polygon_type(nodes)));
  }
  grid.SetCells(types, cells);
}

void set_family(vtkUnsignedCharArray& family, const Mesh& mesh) {
  for (int yarn = 0; yarn < mesh.yarn_count(); ++yarn)
    family.SetValue(yarn, mesh.yarns.family[yarn] == Family::warp ? 1 : 2);
}

}  // namespace

struct FrameWriter::Grid {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkDoubleArray *point = nullptr, *time = nullptr, *displacement = nullptr;
  vtkDoubleArray *shear_angle = nullptr, *absolute_angle = nullptr, *yarn_strain = nullptr, *yarn_force = nullptr;
  vtkDoubleArray *thickness = nullptr, *areal_weight = nullptr;
  vtkFloatArray *warp = nullptr, *weft = nullptr;
  vtkUnsignedCharArray* folded = nullptr;
  // signed: viewers take unsigned bytes for colours
  vtkSignedCharArray *contact_tool = nullptr, *contact_count = nullptr, *friction = nullptr;  // null without tools
  vtkDoubleArray *contact_force = nullptr, *contact_gap = nullptr;
  vtkDoubleArray *contact_pressure = nullptr, *contact_share = nullptr;
  vtkDoubleArray *slip = nullptr, *slip_path = nullptr, *ply_pressure = nullptr;  // null of a single ply
  vtkSignedCharArray *other_ply = nullptr, *ply_friction = nullptr;
  CellsBeside beside;

  Grid(const Mesh& mesh, const std::vector<std::string>& tools) : beside(cells_beside_yarns(mesh)) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(mesh.node_count());
    point = vtkDoubleArray::SafeDownCast(points->GetData());
    grid->SetPoints(points);
    set_topology(*grid, mesh);

    const vtkIdType elements = mesh.yarn_count() + mesh.cells.size();
    vtkFieldData& cell_data = *grid->GetCellData();
    set_family(*add_array<vtkUnsignedCharArray>(cell_data, "family", 1, elements), mesh);
    shear_angle = add_array<vtkDoubleArray>(cell_data, "shear_angle_deg", 1, elements);
    absolute_angle = add_array<vtkDoubleArray>(cell_data, "absolute_shear_angle_deg", 1, elements);
    yarn_strain = add_array<vtkDoubleArray>(cell_data, "yarn_strain", 1, elements);
    yarn_force = add_array<vtkDoubleArray>(cell_data, "yarn_force_N", 1, elements);
    // Directions are for arrows on a screen: single precision does.
    warp = add_array<vtkFloatArray>(cell_data, "warp_direction", 3, elements);
    weft = add_array<vtkFloatArray>(cell_data, "weft_direction", 3, elements);
    folded = add_array<vtkUnsignedCharArray>(cell_data, "folded", 1, elements);
    thickness = add_array<vtkDoubleArray>(cell_data, "thickness_mm", 1, elements);
    areal_weight = add_array<vtkDoubleArray>(cell_data, "areal_weight_ratio", 1, elements);
    displacement = add_array<vtkDoubleArray>(*grid->GetPointData(), "displacement_mm", 3, mesh.node_count());
    time = add_array<vtkDoubleArray>(*grid->GetFieldData(), "TimeValue", 1, 1);
    if (!tools.empty()) add_contact(mesh, tools);
    if (!mesh.ply.empty()) add_plies(mesh);
    grid->GetCellData()->SetActiveScalars("shear_angle_deg");
  }

  void add_contact(const Mesh& mesh, const std::vector<std::string>& tools) {
    vtkFieldData &points = *grid->GetPointData(), &elements = *grid->GetCellData();
    const vtkIdType nodes = mesh.node_count(), count = mesh.yarn_count() + mesh.cells.size();
    contact_tool = add_array<vtkSignedCharArray>(points, "contact_tool", 1, nodes);
    contact_count = add_array<vtkSignedCharArray>(points, "contact_count", 1, nodes);
    contact_force = add_array<vtkDoubleArray>(points, "contact_force_N", 1, nodes);
    contact_gap = add_array<vtkDoubleArray>(points, "contact_gap_mm", 1, nodes);
    friction = add_array<vtkSignedCharArray>(points, "friction_state", 1, nodes);
    contact_pressure = add_array<vtkDoubleArray>(elements, "contact_pressure_MPa", 1, count);
    contact_share = add_array<vtkDoubleArray>(elements, "contact_share", 1, count);
    for (std::size_t k = 0; k < tools.size(); ++k)  // names as arrays, for meshio reads no texts
      add_array<vtkIntArray>(*grid->GetFieldData(), ("tool_" + tools[k]).c_str(), 1, 1)
          ->SetValue(0, static_cast<int>(k) + 1);
  }

  void add_plies(const Mesh& mesh) {
    vtkFieldData &points = *grid->GetPointData(), &elements = *grid->GetCellData();
    const vtkIdType nodes = mesh.node_count(), count = mesh.yarn_count() + mesh.cells.size();
    const std::vector<int> of_nodes = ply_of_nodes(mesh), of_yarns = ply_of_yarns(mesh), of_cells = ply_of_cells(mesh);
    int* next = add_array<vtkIntArray>(elements, "ply", 1, count)->GetPointer(0);
    std::copy(of_cells.begin(), of_cells.end(), std::copy(of_yarns.begin(), of_yarns.end(), next));
    std::copy(of_nodes.begin(), of_nodes.end(), add_array<vtkIntArray>(points, "ply", 1, nodes)->GetPointer(0));
    slip = add_array<vtkDoubleArray>(points, "slip_mm", 3, nodes);
    slip_path = add_array<vtkDoubleArray>(points, "slip_path_mm", 1, nodes);
    ply_pressure = add_array<vtkDoubleArray>(points, "ply_pressure_MPa", 1, nodes);
    other_ply = add_array<vtkSignedCharArray>(points, "other_ply", 1, nodes);
    ply_friction = add_array<vtkSignedCharArray>(points, "ply_friction_state", 1, nodes);
    for (std::size_t k = 0; k < mesh.ply.size(); ++k)
      add_array<vtkIntArray>(*grid->GetFieldData(), ("ply_" + mesh.ply[k].name).c_str(), 1, 1)
          ->SetValue(0, static_cast<int>(k));
  }

  // Values on yarns and on cells stand one behind the other, as the lines and polygons do.
  static void fill(vtkDoubleArray& array, const std::vector<double>& on_yarns, const std::vector<double>& on_cells,
                   double factor) {
    const auto scaled = [factor](double value) { return factor * value; };
    double* next = std::transform(on_yarns.begin(), on_yarns.end(), array.GetPointer(0), scaled);
    std::transform(on_cells.begin(), on_cells.end(), next, scaled);
    array.Modified();  // or VTK writes the first frame's range into every frame
  }

  static void fill(vtkDoubleArray& array, const std::vector<Vec3>& vectors) {
    double* next = array.GetPointer(0);
    for (const Vec3& v : vectors) next = std::copy(v.begin(), v.end(), next);
    array.Modified();
  }

  static void set_direction(vtkFloatArray& array, vtkIdType element, const Vec3& d) {
    for (int k = 0; k < 3; ++k) array.SetTypedComponent(element, k, static_cast<float>(d[k]));
  }

  void fill_directions(const Mesh& mesh, const Fields& fields) const {
    for (int yarn = 0; yarn < mesh.yarn_count(); ++yarn) {
      const Vec3 &a = fields.position[mesh.yarns.node[yarn][0]], &b = fields.position[mesh.yarns.node[yarn][1]];
      const Vec3 along = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
      const double length = std::hypot(along[0], along[1], along[2]);
      const double scale = length > 0.0 ? 1.0 / length : 0.0;
      set_direction(mesh.yarns.family[yarn] == Family::warp ? *warp : *weft, yarn,
                    {along[0] * scale, along[1] * scale, along[2] * scale});
    }
    for (int cell = 0; cell < mesh.cells.size(); ++cell) {
      set_direction(*warp, mesh.yarn_count() + cell, fields.warp[cell]);
      set_direction(*weft, mesh.yarn_count() + cell, fields.weft[cell]);
    }
    warp->Modified();
    weft->Modified();
  }

  void fill_contact(const Mesh& mesh, const ContactState& contact) {
    for (int node = 0; node < mesh.node_count(); ++node) {
      contact_tool->SetValue(node, static_cast<signed char>(contact.tool[node]));
      contact_count->SetValue(node, static_cast<signed char>(contact.count[node]));
      friction->SetValue(node, static_cast<signed char>(contact.friction[node]));
      contact_force->SetValue(node, contact.force[node]);
      contact_gap->SetValue(node, contact.gap[node]);
    }
    const auto set_mean = [&](vtkIdType element, const int* begin, const int* end) {
      double pressure = 0.0, touching = 0.0;
      for (const int* node = begin; node != end; ++node) {
        pressure += contact.pressure[*node];
        touching += contact.tool[*node] > 0 ? 1.0 : 0.0;
      }
      const auto nodes = static_cast<double>(end - begin);
      contact_pressure->SetValue(element, pressure / nodes);
      contact_share->SetValue(element, touching / nodes);
    };
    for (int yarn = 0; yarn < mesh.yarn_count(); ++yarn)
      set_mean(yarn, mesh.yarns.node[yarn].data(), mesh.yarns.node[yarn].data() + 2);
    const int* node = mesh.cells.node.data();
    for (int cell = 0; cell < mesh.cells.size(); ++cell)
      set_mean(mesh.yarn_count() + cell, node + mesh.cells.offset[cell], node + mesh.cells.offset[cell + 1]);
    for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{
             contact_tool, contact_count, friction, contact_force, contact_gap, contact_pressure, contact_share})
      array->Modified();
  }

  void fill_plies(const Mesh& mesh, const PlyContactState& between) {
    fill(*slip, between.slip);
    for (int node = 0; node < mesh.node_count(); ++node) {
      slip_path->SetValue(node, between.slip_path[node]);
      ply_pressure->SetValue(node, between.pressure[node]);
      other_ply->SetValue(node, static_cast<signed char>(between.other[node]));
      ply_friction->SetValue(node, static_cast<signed char>(between.friction[node]));
    }
    for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{slip_path, ply_pressure, other_ply, ply_friction})
      array->Modified();
  }

  void fill(const Mesh& mesh, const Fields& fields) {
    time->SetValue(0, fields.time);
    time->Modified();
    fill(*point, fields.position);
    fill(*displacement, fields.displacement);
    fill(*shear_angle, mean_on_yarns(beside, fields.shear_angle), fields.shear_angle, degrees_per_radian);
    std::vector<double> absolute = fields.shear_angle;
    for (double& angle : absolute) angle = std::abs(angle);
    fill(*absolute_angle, mean_on_yarns(beside, absolute), absolute, degrees_per_radian);
    const int cells = mesh.cells.size();
    fill(*yarn_strain, fields.yarn_strain, mean_on_cells(beside, fields.yarn_strain, cells), 1.0);
    fill(*yarn_force, fields.yarn_force, mean_on_cells(beside, fields.yarn_force, cells), 1.0);
    fill(*thickness, mean_on_yarns(beside, fields.thickness), fields.thickness, 1.0);
    fill(*areal_weight, mean_on_yarns(beside, fields.areal_weight), fields.areal_weight, 1.0);
    if (contact_tool != nullptr) fill_contact(mesh, fields.contact.value());
    if (slip != nullptr && fields.between) fill_plies(mesh, *fields.between);
    fill_directions(mesh, fields);
    for (int cell = 0; cell < cells; ++cell) folded->SetValue(mesh.yarn_count() + cell, fields.folded[cell] ? 1 : 0);
    folded->Modified();
    // forgets what the writer noted on it, so that every frame has the same layout, the first of a run or not
    grid->GetCellData()->GetArray("family")->Modified();
    for (vtkFieldData* data : std::initializer_list<vtkFieldData*>{grid->GetCellData(), grid->GetPointData()})
      if (vtkAbstractArray* array = data->GetAbstractArray("ply")) array->Modified();
    grid->GetPoints()->Modified();
    grid->Modified();
  }
};

FrameWriter::FrameWriter(fs::path directory, const Mesh& mesh, std::vector<double> kept,
                         const std::vector<std::string>& tools)
    : directory_(std::move(directory)),
      mesh_(mesh),
      times_(std::move(kept)),
      grid_(std::make_unique<Grid>(mesh, tools)) {
  if (fs::is_symlink(fs::symlink_status(directory_ / file_name::frames)))
    throw FileError(
        fmt::format("{}: is a link; remove it or choose another folder", (directory_ / file_name::frames).string()));
  for (std::size_t k = 0; k < times_.size(); ++k)
    if (!fs::is_regular_file(fs::symlink_status(directory_ / frame_name(k))))
      throw FileError(fmt::format("{}: not there, but the checkpoint counts {} frames; run again without --resume",
                                  (directory_ / frame_name(k)).string(), times_.size()));
  // Frames of an earlier run in the same folder would otherwise stay behind, numbered past this run's last.
  std::error_code unimportant;
  for (std::size_t k = times_.size(); fs::remove(directory_ / frame_name(k), unimportant); ++k) {
  }
  if (times_.empty())
    fs::remove(directory_ / file_name::index, unimportant);
  else
    write_index();
}

FrameWriter::~FrameWriter() {
  if (at_work_.valid()) at_work_.wait();
}

// Packing takes three times as long as all else of a frame, and as long as some hundred steps of a small scene.
void FrameWriter::write(const Fields& fields) {
  if (at_work_.valid()) at_work_.get();
  grid_->fill(mesh_, fields);
  times_.push_back(fields.time);
  at_work_ = std::async(std::launch::async, [this] { write_last(); });
}

bool FrameWriter::is_writing() const {
  return at_work_.valid() && at_work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

void FrameWriter::write_last() const {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid_->grid);
  write_vtk_whole(directory_ / frame_name(times_.size() - 1), *writer);
  write_index();
}

void FrameWriter::settle() {
  if (at_work_.valid()) at_work_.get();
  for (; settled_ < times_.size(); ++settled_) settle_on_disk(directory_ / frame_name(settled_));
  for (const char* name : {file_name::frames, file_name::index}) settle_on_disk(directory_ / name);
}

void FrameWriter::write_index() const {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"{}Endian\">\n  "
      "<Collection>\n",
      std::endian::native == std::endian::little ? "Little" : "Big");
  for (std::size_t k = 0; k < times_.size(); ++k)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", times_[k], frame_name(k));
  text += "  </Collection>\n</VTKFile>\n";
  write_text_whole(directory_ / file_name::index, text);
}

}  // namespace weaveform
