// One geometry file open in the Gmsh SDK. Gmsh is one global state: set up for one file, gone after it.
#pragma once

#include <filesystem>

namespace weaveform {

// While it lives nothing reaches standard output: OpenCASCADE, which Gmsh reads CAD with, prints to it, where a script
// looks for answers.
class Silence {
public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

private:
  int output_;
};

// Lengths in mm. Throws FileError when the file cannot be read, InputError when Gmsh makes nothing of it.
class GmshSession {
public:
  explicit GmshSession(const std::filesystem::path& file);
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

private:
  Silence silence_;
};

}  // namespace weaveform
