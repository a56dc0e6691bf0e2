// Gmsh scripts are data: what is not geometry is refused with its place.
#include "mesher/tools/geo_script.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "tests/support/instrumented.hpp"
#include "tests/support/mutations.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

std::string script_complaint(const std::string& script) {
  try {
    (void)geometry_script(script, "x.geo");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(GeoScript, WhatDoesMoreThanDescribeGeometryIsRefusedWithItsPlace) {
  for (const std::string command : {"SystemCall \"touch x\";",
                                    "NonBlockingSystemCall \"x\";",
                                    "System \"x\";",
                                    "Include \"x.geo\";",
                                    "Merge \"x.step\";",
                                    "MergeWithBoundingBox \"x\";",
                                    "Save \"x.msh\";",
                                    "Print \"x.png\";",
                                    "Exit;",
                                    "Abort;",
                                    "CreateDir \"x\";",
                                    "OnelabRun(\"x\", \"y\");",
                                    "Plugin(Skin).Run;",
                                    "a = GetEnv(\"HOME\");",
                                    "a = GetNumber(\"x\", 1);",
                                    "a = GetString(\"x\", \"y\");",
                                    "SetNumber(\"x\", 1);",
                                    "SetString(\"x\", \"y\");",
                                    "a() = ListFromFile(\"x\");",
                                    "a() = ShapeFromFile(\"x.step\");",
                                    "v = FileExists(\"x\");",
                                    "Printf(\"x\") > \"f\";",
                                    "Printf(\"x\") >> \"f\";",
                                    "Error(\"x\") > Str(\"f\");",
                                    "Printf(\"%g\", 1) > f;",
                                    "Save View[0] \"x\";",
                                    "View \"x\" {};",
                                    "Sleep 100;",
                                    "Solver.Executable0 = \"rm\";",
                                    "General.DefaultFileName = \"x\";",
                                    "General.TextEditor = \"x\";",
                                    "Print.Text = 1;",
                                    "Geometry.DoubleClickedPointCommand = \"x\";",
                                    "Geometry.OCCTargetUnit = Str(\"M\");",
                                    "Field[1] = ExternalProcess; Field[1].CommandLine = \"x\";",
                                    "Field[1] = Structured;",
                                    "Field[1] = MathEval; Field[1].FileName = \"x\";",
                                    "SomethingNew \"x\";",
                                    "SomethingNew Str(\"x\");",
                                    "SomethingNew 3;",
                                    "DefineConstant[ a = {1, ServerAction \"x\"} ];",
                                    "General.NumThreads = 8;"}) {
    const std::string line =
        script_complaint("SetFactory(\"OpenCASCADE\");\n  " + command + "\nSphere(1) = {0, 0, 0, 1};\n");
    EXPECT_EQ(line.find("x.geo:2:"), 0U) << command << ": " << line;
    EXPECT_NE(line.find("--trust-geo"), std::string::npos) << command << ": " << line;
  }
}

TEST(GeoScript, NothingHidesInCommentsTextsOrLines) {
  // Gmsh's loop goes back to the beginning of a line, which here lies in a comment: it must not see the comment
  const std::string looped = geometry_script("For i In {1:2} /*\nSystemCall \"x\"; */\nEndFor\n", "x.geo");
  EXPECT_EQ(looped.find("SystemCall"), std::string::npos);
  EXPECT_EQ(std::count(looped.begin(), looped.end(), '\n'), 3) << "lines keep their numbers";
  EXPECT_EQ(script_complaint("// SystemCall \"x\";\na = 1; // Merge\n/* Exit; */ b = \"Save SystemCall\";\n"), "");
  EXPECT_EQ(script_complaint("// x\rSystemCall \"x\";\n"), "") << "as Gmsh, a comment ends with its line";
  std::string long_text(1100, 'x');
  long_text.insert(0, "a = \"");
  EXPECT_NE(script_complaint(long_text.append("SystemCall 'touch x'; \";")), "");
  EXPECT_NE(script_complaint("a = \"x\nSystemCall 'x';\n\";"), "");
  EXPECT_NE(script_complaint(std::string("a = 1;\0SystemCall 'x';", 22)), "");
  EXPECT_NE(script_complaint("/* no end"), "");
  EXPECT_NE(script_complaint("1eSystemCall 'x';1e5SystemCall 'x';"), "");
  EXPECT_NE(script_complaint("$MeshFormat\n"), "");
}

TEST(GeoScript, GeometryPassesByteForByte) {
  const std::string script =
      "SetFactory('OpenCASCADE');\nlc = 1.5e-1; n = newp; General.Terminal = 0; Mesh.Algorithm = 6;\n"
      "DefineConstant[ r = {1, Min 0, Max 2, Step 0.1, Name \"radius\"} ];\n"
      "Point(n) = {0, 0, 0, lc}; a~{1} = 2; Point(n + 1) = {#lc, -1, Sqrt(2) ^ 2};\n"
      "Macro Hole1\n  c = newc; Circle(c) = {0, 0, 0, r};\nReturn\nCall Hole1;\n"
      "If(r > 0 && n != 1)\n  Curve Loop(1) = {1 : 4};\nElse\n  Line Loop(2) = {1, -2};\nEndIf\n"
      "Transfinite Curve {1} = 10 Using Progression 1.1;\nRecombine Surface {1};\nPhysical Surface(\"top\", 3) = {1};\n"
      "e() = Extrude {0, 0, 1} { Surface{1}; Layers{5}; };\nRotate {{0, 0, 1}, {0, 0, 0}, Pi/2} { Duplicata { "
      "Volume{1}; } }\n"
      "Field[1] = Distance; Field[1].NumPointsPerCurve = 3; Field[2] = MathEval; Field[2].F = \"x\";\n"
      "Background Field = 2;\nPrintf(\"r = %g\", r);\nMesh.Color.Points = {1, 2, 3};\nMesh 2;\nCoherence;\n";
  EXPECT_EQ(script_complaint(script), "");
  EXPECT_EQ(geometry_script(script, "x.geo"), script);
  for (const auto& entry : std::filesystem::directory_iterator(WEAVEFORM_SOURCE_DIR "/examples/cad"))
    if (entry.path().extension() == ".geo") {
      EXPECT_EQ(script_complaint(test::read_text(entry.path())), "") << entry.path();
    }
}

TEST(GeoScript, ScriptsOfAnyBytesEndSoon) {
  const std::string sound = test::read_text(WEAVEFORM_SOURCE_DIR "/examples/cad/box_punch.geo");
  for (unsigned seed = 0; seed < (test::instrumented ? 200 : 2000); ++seed)
    (void)script_complaint(test::damaged(sound, seed));
  std::string nested, fields;
  for (int k = 0; k < (test::instrumented ? 20000 : 200000); ++k) nested += "Printf(", fields += "Field[";
  EXPECT_NE(script_complaint(nested), "");
  (void)script_complaint(fields);
}

}  // namespace
}  // namespace weaveform
