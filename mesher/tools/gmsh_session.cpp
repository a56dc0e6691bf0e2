#include "mesher/tools/gmsh_session.hpp"

#include <fcntl.h>
#include <gmsh.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "mesher/base/error.hpp"
#include "mesher/base/files.hpp"

namespace weaveform {

Silence::Silence() : output_(dup(STDOUT_FILENO)) {
  std::fflush(stdout);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  dup2(nowhere, STDOUT_FILENO);
  close(nowhere);
}

Silence::~Silence() {
  if (output_ < 0) return;
  std::fflush(stdout);
  std::cout.flush();
  dup2(output_, STDOUT_FILENO);
  close(output_);
}

GmshSession::GmshSession(const std::filesystem::path& file) {
  require_regular_file(file);
  gmsh::initialize(0, nullptr, false);
  try {
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::option::setString("Geometry.OCCTargetUnit", "MM");
    gmsh::open(file.string());
    gmsh::model::occ::synchronize();
  } catch (...) {
    gmsh::finalize();
    throw InputError(file.string() + ": Gmsh cannot read this geometry; write it again as STEP");
  }
}

GmshSession::~GmshSession() {
  gmsh::finalize();
}

}  // namespace weaveform
