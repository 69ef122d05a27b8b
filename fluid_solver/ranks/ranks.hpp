/// What a fluid that is spread over several processes asks of the others. A process has its own particles
/// and, as ghosts in the same arrays, those of others that are near. A fluid in one process has no ranks.
/// What is summed over particles is collected on rank 0, in the order in which one process stores them:
/// sums round as they do there.
#pragma once

#include <span>

#include "common/sph/cluster_list.hpp"
#include "common/sph/exact_sum.hpp"
#include "fluid_solver/particles.hpp"

namespace toryu::fluid {

struct Boundary;

/// Whose rates are found anew beside an interface: the whole fluid's clusters near it, as this rank has them.
struct Renewal {
  std::vector<std::uint32_t> clusters = {};  ///< of this rank, that have one of its own particles among them
  std::vector<std::uint32_t> kept = {};      ///< its own particles in these that belong to no such cluster
};

/// Clusters of this rank that a sweep over pairs need look at.
struct Swept {
  std::vector<std::uint32_t> own = {};   ///< that have one of its own particles among them
  std::vector<std::uint32_t> near = {};  ///< these, and what they see
};

class Ranks {
 public:
  virtual ~Ranks() = default;
  /// Each becomes the largest of all processes.
  virtual void take_largest(std::span<double> values) const = 0;
  double largest(double value) const {
    take_largest({&value, 1});
    return value;
  }
  /// Of the values of the whole fluid; of ghosts they need not be known.
  virtual double largest(const Field& values) const = 0;
  /// Each becomes that of rank 0.
  virtual void take_first(std::span<double> values) const = 0;
  /// Each becomes that of all processes.
  virtual void add_up(std::span<ExactSum> sums) const = 0;
  /// Places of the own particles.
  virtual const std::vector<std::uint32_t>& own() const = 0;

  // where lists of neighbours are built
  /// Rank 0 has all of the fluid, without lists; what others hold nobody asks for.
  virtual void begin(const Particles& fluid, const std::vector<Boundary>& boundaries) = 0;
  /// Gives each process its own particles, with ghosts up to `depth` [m] around them, in the order in which
  /// the whole fluid was stored; `shifts` [m], zero first, are those by which space repeats itself. A field
  /// `beside` those of the fluid goes with them.
  virtual void divide(Particles& fluid, double depth, const std::vector<Vec>& shifts,
                      VecField* beside = nullptr) = 0;
  /// The particles have been sorted: k is now who was at `order`[k].
  virtual void follow(const std::vector<std::uint32_t>& order) = 0;
  /// Finds the places in the whole fluid after sorting by `strips`.
  virtual void number(const Particles& fluid, const StripOrder& strips) = 0;
  /// Notes who is near whom by the lists as they are now; particles at `near_interface` are in reach of a
  /// solid's.
  virtual void note_lists(const Particles& fluid, const ClusterList& neighbours,
                          const std::vector<Boundary>& boundaries,
                          const std::vector<std::uint32_t>& near_interface) = 0;
  /// Keeps who is where, and brings it back.
  virtual void save() = 0;
  virtual void restore() = 0;

  // between two of them
  /// Gives the ghosts what their owners have found.
  virtual void share(const std::vector<Field*>& fields) const = 0;
  virtual const Renewal& beside_interface() const = 0;
  virtual const Swept& swept() const = 0;
  /// Of the particles of the whole fluid on rank 0; 0 elsewhere. And its mass [kg/m].
  virtual std::size_t count_of_whole() const = 0;
  virtual double mass() const = 0;
  /// On rank 0 `force_on_fluid` of each boundary becomes that on the whole fluid.
  virtual void collect_forces(std::vector<Boundary>& boundaries) const = 0;
  /// Brings `values` of the particles near boundary `b`, and their masses, to rank 0, cluster by cluster of
  /// the whole fluid; nothing elsewhere.
  virtual std::vector<Field> collect_beside(std::size_t b, const std::vector<const Field*>& values) const = 0;
  /// On rank 0 `values` of the particles of boundary `b` become those of the ranks that have all of the fluid
  /// near them.
  virtual void collect_at(std::size_t b, const std::vector<Field*>& values) const = 0;
  /// On rank 0 `whole` becomes the values of the whole fluid; elsewhere nothing happens.
  virtual void collect(const std::vector<const Field*>& part, const std::vector<Field*>& whole) const = 0;
  /// Those of one field on rank 0; none elsewhere.
  Field of_whole(const Field& part) const {
    Field whole(padded(count_of_whole()), 0.0);
    collect({&part}, {&whole});
    return whole;
  }
};

/// Sums over the whole fluid of the values that `of_particle(i)` gives, bit for bit the same over any number
/// of processes.
template <std::size_t count, class Of>
std::array<double, count> exact_sums(const Particles& fluid, const Ranks* ranks, Of&& of_particle) {
  std::array<ExactSum, count> sums;
  const std::size_t particles = ranks ? ranks->own().size() : fluid.count;
  for (std::size_t k = 0; k < particles; ++k) {
    const std::array<double, count> parts = of_particle(ranks ? ranks->own()[k] : k);
    for (std::size_t n = 0; n < count; ++n) sums[n].add(parts[n]);
  }
  if (ranks) ranks->add_up(sums);
  std::array<double, count> values;
  for (std::size_t n = 0; n < count; ++n) values[n] = sums[n].value();
  return values;
}

}  // namespace toryu::fluid
