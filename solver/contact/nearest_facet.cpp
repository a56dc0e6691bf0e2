#include "solver/contact/nearest_facet.hpp"

#include <vtkNew.h>
#include <vtkPointLocator.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace weaveform {

struct NearestFacet::Middles {
  vtkNew<vtkPolyData> points;
  vtkNew<vtkPointLocator> locator;
};

NearestFacet::NearestFacet(const PlySurface& surface, const Components& position)
    : middles_(std::make_unique<Middles>()) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int facet = 0; facet < surface.facets(); ++facet) {
    if (!surface.exists(facet)) continue;
    const double middle = surface.is_triangle(facet) ? 1.0 / 3.0 : 0.5;
    place_.push_back({facet, middle, middle});
    points->InsertNextPoint(surface.frame(place_.back(), position).point.data());
  }
  if (place_.empty()) return;
  middles_->points->SetPoints(points);
  middles_->locator->SetDataSet(middles_->points);
  middles_->locator->BuildLocator();
}

NearestFacet::~NearestFacet() = default;

SurfacePlace NearestFacet::operator()(const Vec3& x) const {
  return place_.empty() ? SurfacePlace{} : place_[middles_->locator->FindClosestPoint(x.data())];
}

}  // namespace weaveform
