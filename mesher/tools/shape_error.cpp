#include "mesher/tools/shape_error.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <array>
#include <cmath>

namespace weaveform {

namespace {

// Distance from a point to a surface by Newton's method without second derivatives (Gauss-Newton), from a near place.
// What it finds is never less than the true distance.
double near_distance(const BRepAdaptor_Surface& surface, const gp_XYZ& point, gp_XY uv, double enough) {
  double least = 1e300;
  for (int step = 0; step < 6; ++step) {
    gp_Pnt on;
    gp_Vec du, dv;
    surface.D1(uv.X(), uv.Y(), on, du, dv);
    const gp_Vec off(on, gp_Pnt(point));
    const double distance = off.Magnitude();
    if (distance <= enough) return distance;
    if (!(distance < 0.999 * least)) return least;
    least = distance;
    const double uu = du * du, u_v = du * dv, vv = dv * dv, determinant = uu * vv - u_v * u_v;
    if (!(determinant > 1e-12 * uu * vv)) return least;  // a pole, where one direction is lost
    uv += gp_XY(vv * (off * du) - u_v * (off * dv), uu * (off * dv) - u_v * (off * du)) / determinant;
  }
  return least;
}

class FaceError {
public:
  explicit FaceError(const TopoDS_Face& face) : adaptor_(face, false), surface_(BRep_Tool::Surface(face)) {}

  // The greatest so far, raised to this probe's if that is farther.
  void probe(const gp_XYZ& point, const gp_XY& uv) {
    const double distance = near_distance(adaptor_, point, uv, worst_);
    if (distance <= worst_) return;
    // where the parameters run unevenly the way there is not found from the middle of two
    const gp_Pnt own = gp_Pnt(point).Transformed(adaptor_.Trsf().Inverted());
    (void)surface_.ValueOfUV(own, 1e-7);
    worst_ = std::max(worst_, std::min(distance, surface_.Gap()));
  }
  [[nodiscard]] double worst() const { return worst_; }

private:
  BRepAdaptor_Surface adaptor_;
  ShapeAnalysis_Surface surface_;
  double worst_ = 0.0;
};

double face_error(const TopoDS_Face& face) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation)& mesh = BRep_Tool::Triangulation(face, location);
  if (mesh.IsNull() || !mesh->HasUVNodes() || BRepAdaptor_Surface(face).GetType() == GeomAbs_Plane) return 0.0;
  const gp_Trsf& place = location.Transformation();
  FaceError error(face);
  for (int t = 1; t <= mesh->NbTriangles(); ++t) {
    std::array<int, 3> node{};
    mesh->Triangle(t).Get(node[0], node[1], node[2]);
    gp_XYZ centre;
    gp_XY centre_uv;
    std::array<gp_XYZ, 3> x;
    std::array<gp_XY, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = mesh->Node(node[k]).Transformed(place).XYZ();
      uv[k] = mesh->UVNode(node[k]).XY();
      centre += x[k] / 3.0;
      centre_uv += uv[k] / 3.0;
    }
    error.probe(centre, centre_uv);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (node[k] < node[next]) error.probe(0.5 * (x[k] + x[next]), 0.5 * (uv[k] + uv[next]));  // a side once
    }
  }
  return error.worst();
}

double distance_to_chord(const gp_XYZ& point, const gp_XYZ& from, const gp_XYZ& to) {
  const gp_XYZ chord = to - from;
  const double length = chord.SquareModulus();
  const double along = length > 0.0 ? std::clamp((point - from) * chord / length, 0.0, 1.0) : 0.0;
  return (point - from - along * chord).Modulus();
}

double edge_error(const TopoDS_Edge& edge) {
  Handle(Poly_PolygonOnTriangulation) polygon;
  Handle(Poly_Triangulation) mesh;
  TopLoc_Location location;
  BRep_Tool::PolygonOnTriangulation(edge, polygon, mesh, location);
  if (polygon.IsNull() || mesh.IsNull() || !polygon->HasParameters() || BRep_Tool::Degenerated(edge)) return 0.0;
  const BRepAdaptor_Curve curve(edge);
  if (curve.GetType() == GeomAbs_Line) return 0.0;
  const gp_Trsf& place = location.Transformation();
  double worst = 0.0;
  for (int k = 1; k < polygon->NbNodes(); ++k) {
    const gp_XYZ from = mesh->Node(polygon->Node(k)).Transformed(place).XYZ(),
                 to = mesh->Node(polygon->Node(k + 1)).Transformed(place).XYZ();
    const gp_Pnt middle = curve.Value(0.5 * (polygon->Parameter(k) + polygon->Parameter(k + 1)));
    worst = std::max(worst, distance_to_chord(middle.XYZ(), from, to));
  }
  return worst;
}

}  // namespace

double chord_error(const TopoDS_Shape& shape) {
  double worst = 0.0;
  TopTools_IndexedMapOfShape faces, edges;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  for (int k = 1; k <= faces.Extent(); ++k) worst = std::max(worst, face_error(TopoDS::Face(faces(k))));
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  for (int k = 1; k <= edges.Extent(); ++k) worst = std::max(worst, edge_error(TopoDS::Edge(edges(k))));
  return worst;
}

}  // namespace weaveform
