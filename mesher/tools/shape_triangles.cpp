#include "mesher/tools/shape_triangles.hpp"

#include <fmt/format.h>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepGProp.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Poly_Triangulation.hxx>
#include <ShapeFix_Shape.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mesher/tools/cad_progress.hpp"
#include "mesher/tools/shape_error.hpp"
#include "mesher/tools/shape_nodes.hpp"

namespace weaveform {

namespace {

constexpr double finest = 1e-6;       // of the extent; a tolerance that wants more is a slip of the pen
constexpr double widest_angle = 1.0;  // rad; between chords, so that a hole smaller than the tolerance stays a hole
constexpr int most_rounds = 6;
constexpr double last_excess = 2.0;  // times the tolerance: taken with a word after the last round

// A border, or the seam between two faces that do not know each other.
bool has_free_edges(const TopoDS_Shape& shape) {
  TopTools_IndexedDataMapOfShapeListOfShape faces_of_edge;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of_edge);
  for (int k = 1; k <= faces_of_edge.Extent(); ++k) {
    const TopoDS_Edge& edge = TopoDS::Edge(faces_of_edge.FindKey(k));
    if (faces_of_edge(k).Extent() == 1 && !BRep_Tool::Degenerated(edge) &&
        !BRep_Tool::IsClosed(edge, TopoDS::Face(faces_of_edge(k).First())))
      return true;
  }
  return false;
}

void cut_into_triangles(const TopoDS_Shape& shape, double deflection, double from, double to) {
  BRepTools::Clean(shape);
  IMeshTools_Parameters parameters;
  parameters.Deflection = deflection;
  parameters.Angle = widest_angle;
  CadProgress progress(from, to);
  const BRepMesh_IncrementalMesh mesh(shape, parameters, progress.start());
}

// Faces without triangles that are wider than a sliver, by a point of each.
std::vector<std::string> bare_faces(const TopoDS_Shape& shape, double sliver) {
  std::vector<std::string> places;
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  for (int k = 1; k <= faces.Extent(); ++k) {
    TopLoc_Location location;
    const TopoDS_Face& face = TopoDS::Face(faces(k));
    const auto& triangles = BRep_Tool::Triangulation(face, location);
    if (!triangles.IsNull() && triangles->NbTriangles() > 0) continue;
    GProp_GProps area, border;
    BRepGProp::SurfaceProperties(face, area);
    BRepGProp::LinearProperties(face, border);
    if (2.0 * std::abs(area.Mass()) <= sliver * border.Mass()) continue;
    const gp_Pnt at = border.CentreOfMass();
    places.push_back(fmt::format("about ({:.6g}, {:.6g}, {:.6g}) mm", at.X(), at.Y(), at.Z()));
  }
  return places;
}

// Cut with the repairs that a face without triangles asks for.
TopoDS_Shape cut_whole(TopoDS_Shape shape, double tolerance, const std::string& file) {
  cut_into_triangles(shape, tolerance, reading_share, 0.8);
  if (bare_faces(shape, tolerance).empty()) return shape;
  ShapeFix_Shape repair(shape);
  repair.Perform();
  shape = repair.Shape();
  cut_into_triangles(shape, tolerance, 0.8, 0.9);
  const auto places = bare_faces(shape, tolerance);
  if (places.empty()) return shape;
  throw InputError(fmt::format(
      "{}: {} face{} cannot be cut into triangles, the first {}; its border may cross itself or be open: repair it in "
      "CAD, or write the part as STL",
      file, places.size(), places.size() == 1 ? "" : "s", places.front()));
}

CadSurface within_tolerance(const TopoDS_Shape& whole, double tolerance, const std::string& file) {
  const TopoDS_Shape shape = cut_whole(whole, tolerance, file);
  double deflection = tolerance, error = chord_error(shape), least = error, least_deflection = deflection;
  bool helps = true;  // a fault of the surface stays as it is, however fine the triangles
  for (int round = 1; round < most_rounds && error > tolerance && helps; ++round) {
    deflection *= std::clamp(0.9 * tolerance / error, 0.3, 0.8);
    cut_into_triangles(shape, deflection, 0.9, 1.0);
    error = chord_error(shape);
    helps = error < 0.9 * least;
    if (error < least) least = error, least_deflection = deflection;
  }
  if (least_deflection != deflection) {
    cut_into_triangles(shape, least_deflection, 0.9, 1.0);
    error = chord_error(shape);
  }
  CadSurface surface{joined_triangles(shape), error, {}};
  if (error > last_excess * tolerance)
    throw InputError(
        fmt::format("{}: triangles come within {:.3g} mm of the surface, not within chord_tolerance = {:.3g} mm; ask "
                    "for less",
                    file, error, tolerance));
  if (error > tolerance)
    surface.words.push_back(
        fmt::format("triangles come within {:.3g} mm of the surface, not within {:.3g} mm", error, tolerance));
  return surface;
}

}  // namespace

double extent_of(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box, false);
  if (box.IsVoid()) return 0.0;
  return std::sqrt(box.SquareExtent());
}

// Solids that are closed stay as they are: what merely touches them is not theirs.
TopoDS_Shape sewn_where_open(const TopoDS_Shape& shape, double gap) {
  if (!has_free_edges(shape)) return shape;
  BRep_Builder builder;
  TopoDS_Compound result;
  builder.MakeCompound(result);
  TopTools_IndexedMapOfShape closed, faces;
  for (TopExp_Explorer at(shape, TopAbs_SOLID); at.More(); at.Next()) {
    if (has_free_edges(at.Current())) continue;
    builder.Add(result, at.Current());
    TopExp::MapShapes(at.Current(), TopAbs_FACE, closed);
  }
  BRepBuilderAPI_Sewing sewing(gap);
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  for (int k = 1; k <= faces.Extent(); ++k)
    if (!closed.Contains(faces(k))) sewing.Add(faces(k));
  sewing.Perform();
  if (sewing.SewedShape().IsNull()) return shape;
  builder.Add(result, sewing.SewedShape());
  return result;
}

CadSurface triangles_of_shape(const TopoDS_Shape& shape, double chord_tolerance, const std::string& file) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  if (faces.Extent() == 0) throw InputError(file + ": holds no surface; write the part's faces or solid into it");
  try {
    const double extent = extent_of(shape);
    if (!(chord_tolerance >= finest * extent))
      throw InputError(
          fmt::format("{}: chord_tolerance = {:.3g} mm is too fine for a part {:.4g} mm across; ask for "
                      "{:.2g} mm or more",
                      file, chord_tolerance, extent, finest * extent));
    const double gap = std::min(0.5 * chord_tolerance, widest_gap * extent);
    return within_tolerance(sewn_where_open(shape, gap), chord_tolerance, file);
  } catch (const Standard_Failure& failure) {
    throw InputError(
        fmt::format("{}: OpenCASCADE cannot cut it into triangles ({}); repair it in CAD, or write it as "
                    "STL",
                    file, failure.GetMessageString()));
  }
}

}  // namespace weaveform
