#include "solid_solver/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/error/counted.hpp"
#include "solid_solver/rigid/meeting_bodies.hpp"

namespace toryu::solid {

namespace {

/// Particles of two regions that are nearer at the start, over the spacing: the regions touch.
constexpr double touching = 1.25;

std::vector<Region> regions_of(const Parameters& all, bool rigid) {
  std::vector<Region> found;
  std::copy_if(all.regions.begin(), all.regions.end(), std::back_inserter(found),
               [&](const Region& region) { return region.body.empty() != rigid; });
  return found;
}

Parameters elastic_part(Parameters all) {
  all.regions = regions_of(all, false);
  all.bodies.clear();
  return all;
}

/// With what a rigid body can have.
Parameters rigid_part(const Parameters& all) {
  Parameters own;
  own.formulation = Formulation::rigid;
  own.material = all.material;
  own.spacing = all.spacing;
  own.smoothing_ratio = all.smoothing_ratio;
  own.time_step_share = all.time_step_share;
  own.materials = all.materials;
  own.regions = regions_of(all, true);
  own.holes = all.holes;
  own.loads = all.loads;
  own.observers = all.observers;
  own.initial_velocity = all.initial_velocity;
  own.wall_contact = all.wall_contact;
  own.bodies = all.bodies;
  own.limits.speed = all.limits.speed;
  return own;
}

bool acts_on(const BoxLoad& load, const Body& body) {
  return load.pressure == 0 ? !body.inside(load.box).empty() : !body.surface(load.box).empty();
}

double distance(const Vec& point, const Body& body) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec& X : body.X) nearest = std::min(nearest, (X - point).norm());
  return nearest;
}

/// What lies in neither is left to the elastic part, which tells of it.
void share_loads_and_observers(Part& elastic, Part& rigid, const TellFault& tell_fault) {
  std::erase_if(rigid.parameters.loads, [&](const BoxLoad& load) { return !acts_on(load, rigid.body); });
  std::erase_if(elastic.parameters.loads, [&](const BoxLoad& load) {
    if (!acts_on(load, rigid.body)) return false;
    if (acts_on(load, elastic.body))
      tell_fault(
          item("load", load.name, load.shape.place()),
          fmt::format("load '{}' acts on elastic regions and on rigid bodies: make it of two", load.name));
    return true;
  });
  const auto is_of_rigid = [&](const PointObserver& observer) {
    return distance(observer.point, rigid.body) < distance(observer.point, elastic.body);
  };
  std::erase_if(rigid.parameters.observers, [&](const auto& observer) { return !is_of_rigid(observer); });
  std::erase_if(elastic.parameters.observers, is_of_rigid);
  for (const PointObserver& observer : rigid.parameters.observers)
    if (observer.stress)
      tell_fault(item("observer", observer.name, "stress"),
                 fmt::format("observer '{}': there is no stress in a rigid body", observer.name));
}

void keep_apart(const Part& elastic, const Part& rigid, const TellFault& tell_fault) {
  std::vector<Vec> X = elastic.body.X;
  X.insert(X.end(), rigid.body.X.begin(), rigid.body.X.end());
  std::vector<std::uint32_t> part_of(X.size(), 1);
  std::fill_n(part_of.begin(), elastic.body.size(), 0);
  if (const auto met = meeting_particles(X, part_of, touching * elastic.body.spacing)) {
    const auto i = std::min(met->first, met->second),
               j = std::max(met->first, met->second) - static_cast<std::uint32_t>(elastic.body.size());
    const Region& of_rigid = rigid.parameters.regions[rigid.body.region[j]];
    tell_fault(
        item("region", of_rigid.name, of_rigid.shape.place()),
        fmt::format("region '{}' touches or overlaps region '{}' of the rigid body '{}': they are not "
                    "joined, and need a gap; what is to move with an elastic solid is a region of it "
                    "with a stiff 'material'",
                    elastic.parameters.regions[elastic.body.region[i]].name, of_rigid.name, of_rigid.body));
  }
  for (const Clamp& clamp : elastic.parameters.clamps)
    if (const auto held = rigid.body.inside(clamp.box).size(); held > 0)
      tell_fault(item("clamp", clamp.name, clamp.shape.place()),
                 fmt::format("clamp '{}' holds {} of rigid bodies, which [solid.body.mounting] holds",
                             clamp.name, counted(held, "particle")));
}

}  // namespace

std::vector<Part> build_parts(const Parameters& parameters, const TellFault& tell_fault,
                              const std::vector<Vec>& shifts) {
  if (!parameters.is_mixed()) return {{parameters, build_body(parameters, tell_fault, shifts)}};
  // Only the bodies tell in which of them a load or an observer lies.
  const TellFault of_shapes = [&](const std::string& key, const std::string& message) {
    if (!key.starts_with("solid.load.") && !key.starts_with("solid.observer.")) tell_fault(key, message);
  };
  std::vector<Part> parts;
  for (const Parameters& own : {elastic_part(parameters), rigid_part(parameters)})
    parts.push_back({own, build_body(own, of_shapes, shifts)});
  Part &elastic = parts[0], &rigid = parts[1];
  rigid.body.first = elastic.body.size();
  keep_apart(elastic, rigid, tell_fault);
  share_loads_and_observers(elastic, rigid, tell_fault);
  for (const Part& part : parts) check_loads_and_observers(part.parameters, part.body, tell_fault);
  return parts;
}

}  // namespace toryu::solid
