#include "mesher/tools/geo_words.hpp"

#include <algorithm>
#include <initializer_list>
#include <unordered_set>

namespace weaveform {

namespace {

using Words = std::unordered_set<std::string_view>;

// clang-format off
const Words& geometry_words() {
  static const Words words = {
      // shapes and operations
      "Affine", "BSpline", "Bezier", "Block", "BooleanCoherence", "BooleanCommon", "BooleanCut", "BooleanDifference",
      "BooleanFragments", "BooleanFuse", "BooleanIntersection", "BooleanSection", "BooleanUnion", "BoundingBox", "Box",
      "Catenary", "CatmullRom", "CenterOfMass", "Chamfer", "Circle", "Coherence", "Compound", "Cone", "Coordinates",
      "Curve", "Cylinder", "Degenerated", "Delete", "Dilate", "Disk", "Ellipse", "Ellipsis", "Ellipsoid", "Elliptic",
      "Euclidian", "Extrude", "Fillet", "GeoEntity", "HealShapes", "Hole", "Intersect", "Knots", "Layers", "Line", "Mass",
      "MatrixOfInertia", "Normal", "Nurbs", "Order", "Parametric", "Parent", "Periodic", "Physical", "Plane", "Point",
      "PolarSphere", "Quadric", "Rectangle", "Recursive", "Rotate", "Ruled", "Sewing", "SetFactory", "SetMaxTag", "SetTag",
      "Slide", "Sphere", "Spline", "Split", "Surface", "Symmetry", "ThickSolid", "ThruSections", "Torus", "Translate",
      "Unique", "Volume", "Wedge", "Wire", "newc", "newcl", "newf", "newl", "newll", "newp", "newreg", "news", "newsl",
      "newv",
      // the mesh on them, which is made anew
      "Characteristic", "Field", "Length", "MeshAlgorithm", "MeshSize", "MeshSizeFromBoundary", "QuadTriAddVerts",
      "QuadTriNoNewVerts", "RecombLaterals", "Recomblaterals", "Recombine", "Reverse", "ReverseMesh", "ScaleLastLayer",
      "Smoother", "TransfQuadTri", "Transfinite", "Using",
      // control flow, arithmetic, texts
      "Abs", "Acos", "ArcCos", "ArcSin", "ArcTan", "ArcTan2", "Asin", "Atan", "Atan2", "Call", "Ceil", "Cos", "Cosh",
      "DefineConstant", "DefineNumber", "Else", "ElseIf", "EndFor", "EndIf", "Error", "Exists", "Exp", "Fabs", "Find",
      "Floor", "Fmod", "For", "Function", "GMSH_MAJOR_VERSION", "GMSH_MINOR_VERSION", "GMSH_PATCH_VERSION", "Hide", "Hypot",
      "If", "In", "LinSpace", "List", "Log", "Log10", "LogSpace", "LowerCase", "Macro", "Max", "Min", "Modulo", "Pi",
      "Printf", "Rand", "Return", "Round", "Show", "Sin", "Sinh", "Sprintf", "Sqrt", "Step", "Str", "StrCat", "StrChoice",
      "StrCmp", "StrFind", "StrLen", "StrPrefix", "StrRelative", "StrReplace", "StrSub", "Tan", "Tanh", "UpperCase",
      "Warning"};
  return words;
}

const Words& refused_words() {
  static const Words words = {
      // programs, files, servers, questions
      "CreateDir", "CurrentDir", "CurrentDirectory", "CurrentFileName", "DirName", "AbsolutePath", "FileExists",
      "FixRelativePath", "GetEnv", "GetForced", "GetForcedStr", "GetNumber", "GetString", "GetStringValue", "GetValue",
      "GmshExecutableName", "Include", "ListFromFile", "Merge", "MergeFile", "MergeWithBoundingBox", "NonBlockingSystemCall",
      "OnelabAction", "OnelabCloud", "OnelabRun", "Open", "Parse", "Plugin", "Print", "Save", "SendToServer", "SetNumber",
      "SetString", "ShapeFromFile", "Sleep", "SyncModel", "System", "SystemCall", "UndefineConstant", "DefineString",
      // fields and views that read files or run programs
      "ExternalProcess", "Octree", "PostView", "Structured", "View", "CommandLine", "FileName", "ServerAction",
      // the interpreter, the machine, the screen
      "Abort", "Alias", "AliasWithOptions", "Append", "CodeName", "Color", "ColorTable", "Combine", "CopyOptions", "Cpu",
      "DimNameSpace", "Draw", "Exit", "INTERPOLATION_SCHEME", "MPI_Rank", "MPI_Size", "Memory", "N2S", "NameStruct",
      "NameToString", "NewModel", "S2N", "SetChanged", "SetCurrentWindow", "SplitCurrentWindowHorizontal",
      "SplitCurrentWindowVertical", "StringToName", "Struct", "T2", "T3", "TIME", "TestLevel", "TextAttributes", "Today",
      "TotalMemory", "UnsplitWindow",
      // meshes: what is read here is geometry
      "AdaptMesh", "Betti", "ClassifySurfaces", "Cohomology", "CreateGeometry", "CreateTopology", "Homology", "Levelset",
      "OptimizeMesh", "PartitionMesh", "RecombineMesh", "RefineMesh", "RelocateMesh", "Remesh", "RenumberMeshElements",
      "RenumberMeshNodes", "ReorientMesh", "SetOrder", "SetPartition", "TransformMesh"};
  return words;
}
// clang-format on

}  // namespace

GeoWord kind_of_geo_word(std::string_view word) {
  if (refused_words().count(word) != 0) return GeoWord::refused;
  return geometry_words().count(word) != 0 ? GeoWord::geometry : GeoWord::name;
}

bool may_lead(std::string_view word) {
  static const Words words = {"AutoCheck", "Background",    "Bump",    "Closed",   "Graph", "Help",
                              "Highlight", "Label",         "Loop",    "Mesh",     "Name",  "Power",
                              "Beta",      "Progression",   "Range",   "ReadOnly", "Units", "Choices",
                              "Visible",   "ReadOnlyRange", "SetName", "Index",    "Left",  "Right"};
  return words.count(word) != 0;
}

bool is_field_of_numbers(std::string_view kind) {
  static const Words words = {"Attractor",
                              "AttractorAnisoCurve",
                              "Ball",
                              "BoundaryLayer",
                              "Box",
                              "Constant",
                              "Curvature",
                              "Cylinder",
                              "Distance",
                              "Extend",
                              "Frustum",
                              "Gradient",
                              "Laplacian",
                              "LonLat",
                              "MathEval",
                              "Max",
                              "MaxEigenHessian",
                              "Mean",
                              "Min",
                              "Param",
                              "Restrict",
                              "Threshold"};
  return words.count(kind) != 0;
}

bool is_harmless_option(std::string_view category, std::string_view name) {
  const auto has = [name](std::string_view part) { return name.find(part) != std::string_view::npos; };
  if (has("File") || has("Command") || has("Threads") || has("Unit")) return false;
  if (category == "Mesh" || category == "Geometry") return true;
  if (category != "General") return false;
  const auto looks = {"Alpha",      "Antialiasing", "Axes",         "Background", "Clip",  "Color",
                      "ExpertMode", "NoPopup",      "Orthographic", "Rotation",   "Scale", "SmallAxes",
                      "Terminal",   "Trackball",    "Translation",  "Verbosity"};
  return std::any_of(looks.begin(), looks.end(), [name](std::string_view part) { return name.starts_with(part); });
}

}  // namespace weaveform
