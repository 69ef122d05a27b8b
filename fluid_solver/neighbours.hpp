/// Who is near whom: keeps the particles in strip order and the cluster lists up to date. The lists reach a
/// skin beyond the kernel's support and are built anew only when something may have moved by half of it.
///
/// A skin of s supports adds about s of the time of a step to each step, and to build the lists takes about
/// as long as a step, once in s/m steps where two particles may move by m supports a step: s = sqrt(m) costs
/// least. So the lists of a fluid that hardly moves hold hardly more than the kernel sees.
#pragma once

#include <vector>

#include "common/sph/cluster_list.hpp"
#include "fluid_solver/boundary.hpp"
#include "fluid_solver/particles.hpp"
#include "fluid_solver/ranks/ranks.hpp"

namespace toryu::fluid {

class Neighbours {
 public:
  /// `support` and `largest_skin` [m]; `strip_width` [m] of the storage order; `shifts` [m], zero first, by
  /// which space repeats itself; about an axis the lists lead to images too (axis_images.hpp).
  Neighbours(double support, double largest_skin, double strip_width, std::vector<Vec> shifts,
             Geometry geometry = Geometry::plane)
      : support_(support),
        largest_skin_(largest_skin),
        shifts_(std::move(shifts)),
        geometry_(geometry),
        strips_(strip_width) {}

  /// Whether the next `dt` [s] at the present speeds may exhaust the skin.
  bool exhausted(const Particles& fluid, const std::vector<Boundary>& boundaries, double dt,
                 const Ranks* ranks = nullptr) const;
  /// Sorts the particles and builds the lists anew, for steps of about `dt` [s]. Over `ranks` it divides them
  /// anew before: rates of ghosts are exchanged, but what is found on the way to them is found here.
  void build(Particles& fluid, std::vector<Boundary>& boundaries, double dt, Ranks* ranks = nullptr);

  /// Finds the lists again that were built where a checkpoint says: in a fluid and boundaries whose particles
  /// are in that order.
  void rebuild(const Particles& fluid, std::vector<Boundary>& boundaries);
  /// Divides a fluid over `ranks` that every process has from a checkpoint, with the lists that it says.
  void divide(Particles& fluid, std::vector<Boundary>& boundaries, Ranks& ranks);
  /// Lists of a fluid that has not moved since they were built, as others of the same fluid know of them.
  struct Begun {
    double skin = 0;
    long builds = 0;
  };
  template <class Archive>
  friend void serialize(Archive& archive, Begun& begun) {
    auto& [skin, builds] = begun;
    archive(skin, builds);
  }
  Begun begun() const { return {state_.skin, state_.builds}; }
  void begin_with(const Begun& begun, const Particles& fluid, const std::vector<Boundary>& boundaries);
  /// Frees what takes memory, of a fluid that nobody needs for now.
  void forget(std::vector<Boundary>& boundaries);
  /// How many reaches deep the ghosts of a fluid over ranks are.
  void keep_ghosts(int reaches) { reaches_ = reaches; }
  /// On rank 0 these become those of the whole fluid, of which `part` is spread over `ranks`, without lists.
  static void collect(const Neighbours& part, const Ranks& ranks, Neighbours* whole);

  const ClusterList& of_fluid() const { return of_fluid_; }
  long builds() const { return state_.builds; }

 private:
  /// Where the particles were when the lists were built: who moves, else nothing.
  struct State {
    VecField fluid;
    std::vector<VecField> boundaries;
    double skin = 0;  ///< of these lists [m]
    long builds = 0;
  };
  template <class Archive>
  friend void serialize(Archive& archive, Neighbours& neighbours) {
    auto& [fluid, boundaries, skin, builds] = neighbours.state_;
    archive(fluid, boundaries, skin, builds);
  }
  double best_skin(const Particles& fluid, const std::vector<Boundary>& boundaries, double dt,
                   const Ranks* ranks) const;
  double depth_of_ghosts() const { return reaches_ * (support_ + state_.skin); }  ///< over ranks [m]
  /// Particles of the fluid in reach of the interface.
  std::vector<std::uint32_t> near_interface(std::size_t fluid_count,
                                            const std::vector<Boundary>& boundaries) const;
  void build_lists(std::size_t fluid_count, std::vector<Boundary>& boundaries);

  double support_, largest_skin_;
  int reaches_ = 2;
  std::vector<Vec> shifts_;
  Geometry geometry_;
  StripOrder strips_;
  State state_;
  ClusterList of_fluid_;
};

}  // namespace toryu::fluid
