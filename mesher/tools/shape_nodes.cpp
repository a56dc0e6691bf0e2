#include "mesher/tools/shape_nodes.hpp"

#include <BRep_Tool.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <array>
#include <numeric>
#include <vector>

namespace weaveform {

namespace {

class Joiner {
public:
  explicit Joiner(const TopoDS_Shape& shape) {
    TopExp::MapShapes(shape, TopAbs_FACE, faces_);
    TopExp::MapShapes(shape, TopAbs_EDGE, edges_);
    TopExp::MapShapes(shape, TopAbs_VERTEX, vertices_);
    at_edge_.resize(edges_.Extent() + 1);
    at_vertex_.assign(vertices_.Extent() + 1, -1);
  }

  TriangleList joined() {
    for (int k = 1; k <= faces_.Extent(); ++k) take(TopoDS::Face(faces_(k)));
    TriangleList list;
    std::vector<int> place(point_.size(), -1);
    for (const auto& corner : triangle_) {
      const std::array<int, 3> joined = {root(corner[0]), root(corner[1]), root(corner[2])};
      if (joined[0] == joined[1] || joined[1] == joined[2] || joined[2] == joined[0]) continue;
      std::array<int, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        int& at = place[joined[k]];
        if (at < 0) {
          at = static_cast<int>(list.point.size());
          list.point.push_back(point_[joined[k]]);
        }
        triangle[k] = at;
      }
      list.triangle.push_back(triangle);
    }
    return list;
  }

private:
  void take(const TopoDS_Face& face) {
    TopLoc_Location location;
    const Handle(Poly_Triangulation)& mesh = BRep_Tool::Triangulation(face, location);
    if (mesh.IsNull()) return;
    const int first = static_cast<int>(point_.size()) - 1;  // OpenCASCADE counts from 1
    for (int n = 1; n <= mesh->NbNodes(); ++n) {
      const gp_Pnt x = mesh->Node(n).Transformed(location.Transformation());
      point_.push_back({x.X(), x.Y(), x.Z()});
      parent_.push_back(static_cast<int>(parent_.size()));
    }
    const bool reversed = face.Orientation() == TopAbs_REVERSED;
    for (int t = 1; t <= mesh->NbTriangles(); ++t) {
      std::array<int, 3> node{};
      mesh->Triangle(t).Get(node[0], node[1], node[2]);
      if (reversed) std::swap(node[1], node[2]);
      triangle_.push_back({first + node[0], first + node[1], first + node[2]});
    }
    for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next())
      join(TopoDS::Edge(at.Current()), mesh, location, first);
  }

  // A seam is met twice, once each way, and has its points on either side of the face's parameters.
  void join(const TopoDS_Edge& edge, const Handle(Poly_Triangulation) & mesh, const TopLoc_Location& location,
            int first) {
    const auto& polygon = BRep_Tool::PolygonOnTriangulation(edge, mesh, location);
    const int number = edges_.FindIndex(edge);
    if (polygon.IsNull() || number == 0) return;
    const int count = polygon->NbNodes();
    std::vector<int>& known = at_edge_[number];
    for (int k = 1; k <= count; ++k) {
      const int node = first + polygon->Node(k);
      if (static_cast<int>(known.size()) < k)
        known.push_back(node);
      else
        unite(known[k - 1], node);
    }
    join_end(TopExp::FirstVertex(edge), first + polygon->Node(1));
    join_end(TopExp::LastVertex(edge), first + polygon->Node(count));
    if (BRep_Tool::Degenerated(edge))
      for (int k = 2; k <= count; ++k) unite(first + polygon->Node(1), first + polygon->Node(k));
  }

  void join_end(const TopoDS_Vertex& vertex, int node) {
    const int number = vertex.IsNull() ? 0 : vertices_.FindIndex(vertex);
    if (number == 0) return;
    if (at_vertex_[number] < 0)
      at_vertex_[number] = node;
    else
      unite(at_vertex_[number], node);
  }

  int root(int n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  void unite(int a, int b) { parent_[root(b)] = root(a); }

  TopTools_IndexedMapOfShape faces_, edges_, vertices_;
  std::vector<std::vector<int>> at_edge_;  // points along each edge, as first met
  std::vector<int> at_vertex_;
  std::vector<std::array<double, 3>> point_;
  std::vector<std::array<int, 3>> triangle_;
  std::vector<int> parent_;  // points that are one form a tree
};

}  // namespace

TriangleList joined_triangles(const TopoDS_Shape& shape) {
  return Joiner(shape).joined();
}

}  // namespace weaveform
