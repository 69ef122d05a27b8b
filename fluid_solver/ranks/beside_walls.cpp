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

/// Cluster by cluster, with a factor `m` of each particle if there is one.
std::vector<Vec> BesideWalls::sums(std::size_t b, const VecField& values, const Field* m) const {
  const auto whole = collect(b, {&values[0], &values[1]});
  std::vector<Vec> by_cluster;
  for (std::size_t first = 0; first < beside_[b].lanes; first += lane_count)
    by_cluster.push_back(
        lane_sums(m ? load(*m, first) : Lanes(1.0), VecLanes{load(whole[0], first), load(whole[1], first)}));
  return by_cluster;
}

void BesideWalls::collect_forces(std::vector<Boundary>& boundaries) const {
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    ForceOnFluid& force = boundaries[b].force_on_fluid;
    force.by_cluster = sums(b, force.by_particle, &beside_[b].m);
    if (!force.further_by_particle[0].empty()) {
      const auto further = sums(b, force.further_by_particle, &beside_[b].m);
      for (std::size_t c = 0; c < further.size(); ++c) force.by_cluster[c] += further[c];
    }
    if (!force.friction_by_particle[0].empty())
      force.friction_by_cluster = sums(b, force.friction_by_particle, nullptr);
  }
}

}  // namespace toryu::fluid
