// The facet of a surface whose middle is nearest to a point: where a search for a foot starts when nothing is known.
#pragma once

#include <memory>
#include <vector>

#include "core/vector/vector.hpp"
#include "solver/contact/ply_surface.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

class NearestFacet {
public:
  // As the surface lies now.
  NearestFacet(const PlySurface& surface, const Components& position);
  ~NearestFacet();
  NearestFacet(const NearestFacet&) = delete;
  NearestFacet& operator=(const NearestFacet&) = delete;

  [[nodiscard]] SurfacePlace operator()(const Vec3& x) const;  // nowhere on a surface without facets

private:
  struct Middles;
  std::unique_ptr<Middles> middles_;
  std::vector<SurfacePlace> place_;
};

}  // namespace weaveform
