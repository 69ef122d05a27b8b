#include "solid_solver/periodic_space.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace toryu::solid {

namespace {

std::vector<Box> boxes_of(const auto& shapes) {
  std::vector<Box> boxes;
  boxes.reserve(shapes.size());
  for (const auto& shape : shapes) boxes.push_back(shape.box);
  return boxes;
}

/// Whether the body's regions meet themselves or each other across a side, so that it has no ends.
bool meets_its_image(const Parameters& p, const Period& period) {
  const double touch = 1e-6 * p.spacing;
  const auto boxes = boxes_of(p.regions);
  const auto all = with_images(boxes, period.shifts());
  return std::any_of(
      all.begin() + static_cast<std::ptrdiff_t>(boxes.size()), all.end(), [&](const Box& image) {
        return std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
          return (image.max.cwiseMin(box.max) - image.min.cwiseMax(box.min)).minCoeff() > -touch;
        });
      });
}

}  // namespace

std::vector<std::pair<std::string, std::string>> periodic_faults(const Parameters& p, const Scene& scene) {
  const Period period(scene);
  std::vector<std::pair<std::string, std::string>> faults;
  if (!period.any()) return faults;
  const auto refuse = [&](const std::string& key, const std::string& what) {
    faults.emplace_back(key, what + " in space that repeats itself ([case] periodic)");
  };
  if (p.formulation == Formulation::updated_lagrangian)
    refuse("solid.formulation", "only a solid by \"total_lagrangian\" or \"rigid\" can be");
  if (p.detachment) refuse("solid.detachment", "particles that come off are not looked for");
  if (!p.bodies.empty()) refuse("solid.body", "a rigid body is the only one");
  if (p.formulation == Formulation::rigid && !(p.mounting && p.mounting->is_fixed(dim)) &&
      meets_its_image(p, period))
    faults.emplace_back(
        "solid.mounting",
        "a rigid body that meets its image across a side of [case.domain] has no ends and cannot "
        "turn: give it fixed = [\"angle\"]");
  for (std::size_t k = 0; k < p.clamps.size(); ++k)
    if (p.clamps[k].motion && p.clamps[k].motion->turns())
      refuse(fmt::format("solid.clamp.{}", k), "clamps do not turn");
  for (int axis = 0; axis < dim; ++axis) {
    if (!period.along(axis)) continue;
    const double length = period.length()[axis], reach = 2.0 * p.h();
    if (length < 2 * reach)
      faults.emplace_back("case.periodic",
                          fmt::format("the domain repeats itself in {} after {:.6g} m, which is shorter than "
                                      "{:.6g} m, twice the reach of the solid's particles",
                                      "xy"[axis], length, 2 * reach));
    for (std::size_t k = 0; k < p.regions.size(); ++k) {
      const Box& box = p.regions[k].box;
      const double middle = 0.5 * (box.min[axis] + box.max[axis]);
      if (middle < scene.domain.min[axis] || middle > scene.domain.max[axis])
        faults.emplace_back(
            fmt::format("solid.region.{}.{}", k, p.regions[k].shape.place()),
            fmt::format("the middle of region '{}' lies outside [case.domain], at {} = {:.6g} m: move it by "
                        "whole periods",
                        p.regions[k].name, "xy"[axis], middle));
    }
  }
  return faults;
}

void repeat_holes(const Period& period, Parameters& p) {
  for (const Box& image : images_in(boxes_of(p.regions), boxes_of(p.holes), period, 1e-6 * p.spacing))
    p.holes.push_back({"image of a hole", image});
}

}  // namespace toryu::solid
