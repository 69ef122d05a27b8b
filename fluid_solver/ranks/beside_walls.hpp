/// The fluid near the boundaries over MPI ranks: what boundaries do to it is summed on rank 0, by the
/// clusters of the whole fluid.
#pragma once

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/ranks/gatherer.hpp"

namespace toryu::fluid {

class BesideWalls {
 public:
  BesideWalls() = default;
  /// By the lists as they are now; `own` particles of this rank have a `place_in_whole`.
  BesideWalls(MPI_Comm communicator, const Particles& fluid, const std::vector<Boundary>& boundaries,
              const std::vector<std::uint32_t>& own, const std::vector<std::uint32_t>& place_in_whole);

  /// See Ranks.
  void collect_forces(std::vector<Boundary>& boundaries) const;
  std::vector<Field> collect(std::size_t b, const std::vector<const Field*>& values) const;

 private:
  /// Of one boundary. A lane of rank 0 to which no rank brings a value stays 0.
  struct Beside {
    Gatherer gatherer = {};
    std::size_t lanes = 0;  ///< of the whole clusters, on rank 0
    Field m = {};           ///< of the particles in them [kg/m]
  };
  std::vector<Vec> sums(std::size_t b, const VecField& values, const Field* m) const;
  std::vector<Beside> beside_ = {};
};

}  // namespace toryu::fluid
