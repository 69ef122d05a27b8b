#include "fluid_solver/axisymmetry.hpp"

#include <fmt/format.h>

#include "fluid_solver/wall_rows.hpp"

namespace toryu::fluid {

namespace {

/// Terms that are the same about an axis, or of which terms/axisymmetry.hpp knows how.
template <class Term>
constexpr bool goes_about_axis =
    is_one_of<Term, BackgroundPressure, EnclosedMedium, DensityDiffusion, LaminarViscosity, PowerLaw,
              HerschelBulkley, Carreau, SlipLaw, Friction, Removal>;

}  // namespace

std::vector<StartFault> axis_faults(const Parameters& p, const Scene& scene) {
  if (scene.geometry == Geometry::plane) return {};
  std::vector<StartFault> faults;
  const auto require = [&](bool holds, const std::string& key, const std::string& message) {
    if (!holds) faults.push_back({key, message});
  };
  for_each_term(p, [&]<class Term>(const std::optional<Term>& term) {
    require(goes_about_axis<Term> || !term, fmt::format("fluid.{}", Term::section),
            fmt::format("'{}' is of the plane: [case] geometry = \"axisymmetric\" does not have it",
                        Term::section));
  });
  require(p.model == Model::weakly_compressible, "fluid.model",
          "implicit steps are of the plane: [case] geometry = \"axisymmetric\" does not have them");
  require(!p.initial_flow, "fluid.initial_flow",
          "the initial flows are of the plane: [case] geometry = \"axisymmetric\" does not have them");
  require(p.wall_model.density == WallDensity::rest && p.wall_model.suction, "fluid.wall_model",
          "about an axis walls have the rest density, and suction: leave 'density' and 'suction' out");
  for (const auto& [key, boxes] :
       {std::pair("region", blocks_of(p).boxes), std::pair("hole", blocks_of(p).holes)})
    for (std::size_t k = 0; k < boxes.size(); ++k)
      require(boxes[k].min[1] >= 0, fmt::format("fluid.{}.{}", key, k),
              "the box crosses the axis: y is the distance from it, at least 0");
  for (std::size_t k = 0; k < p.observers.size(); ++k) {
    const Observer& observer = p.observers[k];
    require(observer.point[1] >= 0 && (!observer.box || observer.box->min[1] >= 0),
            fmt::format("fluid.observer.{}", k),
            "the observer lies beyond the axis: y is the distance from it, at least 0");
    const bool flows = observer.quantity == Quantity::flow_rate || observer.quantity == Quantity::volume_flux;
    require(!flows || observer.axis == Axis::x, fmt::format("fluid.observer.{}", k),
            "about an axis a flow rate counts along it: axis = \"x\"");
  }
  return faults;
}

}  // namespace toryu::fluid
