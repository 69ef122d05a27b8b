/// A fluid that is spread over MPI ranks, as the program on rank 0 sees it: a model of the whole, which at
/// the first step hands its particles out to the parts. It has these advanced on each rank, and where it is
/// asked for its state it brings together what the answer takes, until the next step.
#pragma once

#include <functional>
#include <utility>

#include "fluid_solver/ranks/orders.hpp"
#include "fluid_solver/ranks/zoltan_ranks.hpp"
#include "fluid_solver/weakly_compressible/weakly_compressible.hpp"

namespace toryu::fluid {

class SpreadFluid final : public WeaklyCompressible {
 public:
  /// On rank 0; the others `follow`.
  SpreadFluid(const Parameters& parameters, const Scene& scene, MPI_Comm communicator);

  double time_step_limit() const override;
  std::string_view time_step_rule() const override;
  void advance(double dt) override;
  void save() override;
  void restore() override;
  void write_state(std::ostream& stream) const override;
  void read_state(std::istream& stream) override;
  void check(double time) const override;
  Frame frame() const override;
  std::optional<Frame> walls() const override;
  std::vector<Observation> observe() const override;
  void watch(double time) override;
  Look look() override;
  double density_of_packing() const override;

  void record_surface(const std::filesystem::path& out) override;
  void attach(const Interface& interface, bool rigid) override;
  void begin_window(const InterfaceMotion& motion, double dt) override;
  InterfaceLoad take_load() override;
  const Timers& timers() const override { return part_.timers(); }

 private:
  /// Gives the order, and does this rank's share of it.
  void together(const Order& order, const std::function<void()>& share) const;
  void find_off_surface() override;
  void hand_out();
  void spread(Particles fluid, const Begun& begun);
  /// What is known here of the whole as it is now.
  enum class Known { nothing, reported, all };
  void collect(Known wanted) const;
  void forget();

  MPI_Comm communicator_;
  ZoltanRanks ranks_of_parts_;
  mutable WeaklyCompressible part_;
  FluidModel& whole_ = *this;  ///< which who only asks brings up to date too
  bool handed_out_ = false;
  mutable Known known_ = Known::all;
};

/// Does what rank 0 orders, until it orders the end: on the other ranks, of the case that `read` gives.
void follow(MPI_Comm communicator, const std::function<std::pair<Parameters, Scene>()>& read);

}  // namespace toryu::fluid
