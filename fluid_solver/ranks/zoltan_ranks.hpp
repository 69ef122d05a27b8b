/// The fluid over MPI ranks, by recursive coordinate bisection (Berger & Bokhari 1987) of Zoltan. The cuts
/// are kept: by them every rank knows who owns a place and which ranks are near it.
#pragma once

#include <mpi.h>
#include <zoltan.h>

#include <memory>

#include "fluid_solver/ranks/beside_walls.hpp"
#include "fluid_solver/ranks/ranks.hpp"

namespace toryu::fluid {

/// Who is where since lists of neighbours were built last.
struct Division {
  bool divided_ = false;                  ///< else every rank has all of the fluid
  std::vector<std::uint32_t> held_ = {};  ///< numbers of the particles as `divide` leaves them
  std::vector<int> owners_ = {};          ///< of these
  /// By place: the place in the whole fluid. Sorting keeps the order of ties, so it must be known.
  std::vector<std::uint32_t> place_in_whole_ = {};
  std::vector<std::uint32_t> own_ = {};  ///< places of the own particles
  /// Places, by rank: of own particles of which it has ghosts, and of ghosts that it owns.
  std::vector<std::vector<std::uint32_t>> ghosts_there_ = {}, ghosts_here_ = {};
  Gatherer whole_ = {};  ///< of the own particles
  Field masses_ = {};    ///< of the whole fluid, on rank 0 [kg/m]
  BesideWalls beside_walls_ = {};
  Renewal renewal_ = {};
  std::vector<Gatherer> at_walls_ = {};  ///< by boundary: of its particles
};

class ZoltanRanks final : public Ranks, private Division {
 public:
  explicit ZoltanRanks(MPI_Comm communicator);

  double largest(double value) const override;
  double largest(const Field& values) const override;
  bool divided() const override { return divided_; }
  void divide(Particles& fluid, double depth, const std::vector<Vec>& shifts, VecField* beside) override;
  void find(const Particles& fluid) override;
  void number(const Particles& fluid, const StripOrder& strips) override;
  void note_lists(const Particles& fluid, const std::vector<Boundary>& boundaries,
                  const std::vector<std::uint32_t>& near_interface) override;
  const Renewal& beside_interface() const override { return renewal_; }
  void save() override { saved_ = *this; }
  void restore() override { static_cast<Division&>(*this) = saved_; }
  void share(const std::vector<Field*>& fields) const override;
  const Field& masses() const override { return masses_; }
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
  /// Ranks whose parts are nearer than `depth` [m] to `x`, or to an image of it.
  std::vector<std::size_t> ranks_near(const Vec& x, double depth, const std::vector<Vec>& shifts) const;
  void balance(const Particles& fluid);
  bool is_balanced() const;
  Renewal renewal(const std::vector<std::uint32_t>& near) const;
  std::vector<std::uint32_t> own_of(const Boundary& boundary) const;

  MPI_Comm communicator_;
  int rank_ = 0, size_ = 1;
  std::unique_ptr<Zoltan_Struct, Destroy> zoltan_;
  long balancings_ = 0;
  Division saved_ = {};
};

}  // namespace toryu::fluid
