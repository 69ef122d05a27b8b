#include "fluid_solver/ranks/beside_walls.hpp"

#include <algorithm>

#include "fluid_solver/weakly_compressible/pair_loop.hpp"

namespace toryu::fluid {

namespace {

/// Brings the places of whole clusters together: cluster by cluster that has any, in their order. Returns how
/// many lanes these have.
std::size_t close_up(std::vector<std::uint32_t>& places) {
  std::vector<std::uint32_t> clusters;
  for (const auto place : places) clusters.push_back(place / lane_count);
  std::sort(clusters.begin(), clusters.end());
  clusters.erase(std::unique(clusters.begin(), clusters.end()), clusters.end());
  for (auto& place : places) {
    const auto here = std::lower_bound(clusters.begin(), clusters.end(), place / lane_count);
    place = static_cast<std::uint32_t>(here - clusters.begin()) * lane_count + place % lane_count;
  }
  return clusters.size() * lane_count;
}

}  // namespace

BesideWalls::BesideWalls(MPI_Comm communicator, const Particles& fluid,
                         const std::vector<Boundary>& boundaries, const std::vector<std::uint32_t>& own,
                         const std::vector<std::uint32_t>& place_in_whole) {
  for (const Boundary& boundary : boundaries) {
    std::vector<std::uint32_t> near, places;
    for (const auto i : own)
      if (boundary.acts_on(i / lane_count)) near.push_back(i), places.push_back(place_in_whole[i]);
    Beside& beside = beside_.emplace_back();
    beside.gatherer = Gatherer(communicator, std::move(near), places);
    beside.lanes = close_up(beside.gatherer.places());
    beside.m.assign(beside.lanes, 0.0);
    beside.gatherer.gather({&fluid.m}, {&beside.m});
  }
}

std::vector<Field> BesideWalls::collect(std::size_t b, const std::vector<const Field*>& values) const {
  const Beside& beside = beside_[b];
  std::vector<Field> whole(values.size(), Field(beside.lanes, 0.0));
  std::vector<Field*> pointers;
  for (Field& field : whole) pointers.push_back(&field);
  beside.gatherer.gather(values, pointers);
  whole.push_back(beside.m);
  return whole;
}

void BesideWalls::collect_forces(std::vector<Boundary>& boundaries) const {
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    ForceOnFluid& force = boundaries[b].force_on_fluid;
    const auto whole = collect(b, {&force.by_particle[0], &force.by_particle[1]});
    force.by_cluster.clear();
    for (std::size_t first = 0; first < beside_[b].lanes; first += lane_count)
      force.by_cluster.push_back(
          lane_sums(load(whole[2], first), VecLanes{load(whole[0], first), load(whole[1], first)}));
  }
}

}  // namespace toryu::fluid
