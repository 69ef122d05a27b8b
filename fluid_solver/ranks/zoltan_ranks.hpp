/// The fluid over MPI ranks, by recursive coordinate bisection (Berger & Bokhari 1987) of Zoltan. The cuts
/// are kept: by them every rank knows who owns a place and which ranks are near it.
#pragma once

#include <mpi.h>
#include <zoltan.h>

#include <memory>

#include "fluid_solver/ranks/ranks.hpp"

namespace toryu::fluid {

class ZoltanRanks final : public Ranks {
 public:
  explicit ZoltanRanks(MPI_Comm communicator);

  double largest(double value) const override;
  void divide(Particles& fluid, double depth) override;
  void find(const Particles& fluid, const StripOrder& strips) override;
  void share_rates(Particles& fluid) const override;
  /// The state of the whole fluid in the order in which one process stores it, on rank 0; no particles
  /// elsewhere.
  Particles gather(const Particles& fluid) const;

  int size() const { return size_; }
  std::size_t own_count() const { return own_.size(); }
  /// How often the cuts were made anew.
  long balancings() const { return balancings_; }

  /// So much more than its share may a rank own before the cuts are made anew.
  static constexpr double bearable_imbalance = 0.05;

 private:
  struct Destroy {
    void operator()(Zoltan_Struct* zoltan) const { Zoltan_Destroy(&zoltan); }
  };
  void balance(const Particles& fluid);
  bool is_balanced() const;
  void number_all(const Particles& fluid, const StripOrder& strips);

  MPI_Comm communicator_;
  int rank_ = 0, size_ = 1;
  std::unique_ptr<Zoltan_Struct, Destroy> zoltan_;
  long balancings_ = 0;
  std::vector<std::uint32_t> held_;  ///< numbers of the particles as `divide` leaves them
  std::vector<int> owners_;          ///< of these
  /// By place: the place in the whole fluid. Sorting keeps the order of ties, so it must be known.
  std::vector<std::uint32_t> place_in_whole_;
  std::vector<std::uint32_t> own_ = {};  ///< places of the own particles
  /// Places, by rank: of own particles of which it has ghosts, and of ghosts that it owns.
  std::vector<std::vector<std::uint32_t>> ghosts_there_, ghosts_here_;
};

}  // namespace toryu::fluid
