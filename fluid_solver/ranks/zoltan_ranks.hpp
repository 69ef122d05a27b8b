/// The fluid over MPI ranks, by recursive coordinate bisection (Berger & Bokhari 1987) of Zoltan. The cuts
/// are kept: by them every rank knows who owns a place and which ranks are near it.
#pragma once

#include <mpi.h>
#include <zoltan.h>

#include <memory>

#include "common/scene/box.hpp"
#include "fluid_solver/ranks/beside_walls.hpp"
#include "fluid_solver/ranks/carrying.hpp"
#include "fluid_solver/ranks/numbering.hpp"
#include "fluid_solver/ranks/ranks.hpp"

namespace toryu::fluid {

/// Who is where since lists of neighbours were built last.
struct Division {
  /// By place: the place in the whole fluid. Sorting keeps the order of ties, so it must be known.
  std::vector<std::uint32_t> place_in_whole_ = {};
  std::vector<std::uint32_t> own_ = {};  ///< places of the own particles
  /// Places, by rank: of own particles of which it has ghosts, and of ghosts that it owns.
  std::vector<std::vector<std::uint32_t>> ghosts_there_ = {}, ghosts_here_ = {};
  Gatherer whole_ = {};  ///< of the own particles
  std::size_t count_of_whole_ = 0;
  double mass_ = 0;  ///< of the whole fluid [kg/m]
  BesideWalls beside_walls_ = {};
  Renewal renewal_ = {};
  Swept swept_ = {};
  std::vector<Gatherer> at_walls_ = {};  ///< by boundary: of its particles
};

class ZoltanRanks final : public Ranks, private Division {
 public:
  explicit ZoltanRanks(MPI_Comm communicator);

  using Ranks::largest;
  void take_largest(std::span<double> values) const override;
  double largest(const Field& values) const override;
  void take_first(std::span<double> values) const override {
    MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, 0, communicator_);
  }
  void add_up(std::span<ExactSum> sums) const override;
  const std::vector<std::uint32_t>& own() const override { return own_; }
  void begin(const Particles& fluid, const std::vector<Boundary>& boundaries) override;
  void divide(Particles& fluid, double depth, const std::vector<Vec>& shifts, VecField* beside) override;
  void follow(const std::vector<std::uint32_t>& order) override;
  void number(const Particles& fluid, const StripOrder& strips) override {
    fluid::number(communicator_, fluid, strips, own_, place_in_whole_);
  }
  void note_lists(const Particles& fluid, const ClusterList& neighbours,
                  const std::vector<Boundary>& boundaries,
                  const std::vector<std::uint32_t>& near_interface) override;
  const Renewal& beside_interface() const override { return renewal_; }
  const Swept& swept() const override { return swept_; }
  void save() override { saved_ = *this; }
  void restore() override { static_cast<Division&>(*this) = saved_; }
  void share(const std::vector<Field*>& fields) const override;
  std::size_t count_of_whole() const override { return count_of_whole_; }
  double mass() const override { return mass_; }
  void collect_forces(std::vector<Boundary>& boundaries) const override {
    beside_walls_.collect_forces(boundaries);
  }
  std::vector<Field> collect_beside(std::size_t b, const std::vector<const Field*>& values) const override {
    return beside_walls_.collect(b, values);
  }
  void collect_at(std::size_t b, const std::vector<Field*>& values) const override {
    at_walls_[b].gather({values.begin(), values.end()}, values);
  }
  void collect(const std::vector<const Field*>& part, const std::vector<Field*>& whole) const override {
    whole_.gather(part, whole);
  }

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
  int owner_of(const Vec& x) const;
  Box box_of_own(const Particles& fluid) const;
  std::vector<std::vector<std::uint32_t>> ghosts_of_others(const Particles& fluid, double depth,
                                                           const std::vector<Vec>& shifts) const;
  Joined exchange(Particles& fluid, VecField* beside, const std::vector<std::uint32_t>& kept,
                  const std::vector<std::vector<std::uint32_t>>& places);
  void balance(const Particles& fluid);
  bool is_balanced() const;
  void note_own(const Particles& fluid);
  Renewal renewal(const std::vector<std::uint32_t>& near) const;
  Swept swept_by(const ClusterList& neighbours) const;
  std::vector<std::uint32_t> own_of(const Boundary& boundary) const;

  MPI_Comm communicator_;
  int rank_ = 0, size_ = 1;
  std::unique_ptr<Zoltan_Struct, Destroy> zoltan_;
  long balancings_ = 0;
  std::vector<Box> parts_;  ///< by rank: inside which it owns all places [m]
  Division saved_ = {};
};

}  // namespace toryu::fluid
