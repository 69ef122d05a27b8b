/// Elastic regions and rigid bodies beside each other. Each part is a model of its own that moves as it would
/// alone with the same steps, which are those of the faster one. Particles are numbered and drawn part by
/// part; energies, momenta and impulses are sums. The parts do not push each other: where they meet the run
/// ends.
#pragma once

#include <array>
#include <memory>

#include "solid_solver/solid_model.hpp"

namespace toryu::solid {

class MixedSolid final : public Solid {
 public:
  MixedSolid(std::unique_ptr<SolidModel> elastic, std::unique_ptr<SolidModel> rigid);

  double time_step_limit() const override { return faster().time_step_limit(); }
  std::string_view time_step_rule() const override { return faster().time_step_rule(); }
  void advance(double dt) override;
  void save() override;
  void restore() override;
  void accept() override;
  void write_state(std::ostream& stream) const override;
  void read_state(std::istream& stream) override;
  void check(double time) const override;
  /// Where the rigid part lacks a field (stress, what has come off) it is zero there.
  Frame frame() const override;
  std::vector<Observation> observe() const override;
  std::vector<ActiveTerm> active_terms() const override;
  std::vector<std::pair<std::string, double>> figures() const override { return elastic().figures(); }
  std::size_t particle_count() const override;

  Interface interface(double reach) const override;
  InterfaceMotion motion(const std::vector<std::uint32_t>& particles) const override;
  Vec set_interface_load(const std::vector<std::uint32_t>& particles, const InterfaceLoad& load) override;
  std::vector<double> excess_impulse() const override;
  double work_of_excess_impulse() const override;
  Health health() const override;
  void record_detached(const RecordDetached& record) override { parts_[0]->record_detached(record); }
  const Timers& timers() const override { return timers_; }

  const SolidModel& elastic() const { return *parts_[0]; }
  const SolidModel& rigid() const { return *parts_[1]; }

 private:
  const SolidModel& faster() const {
    return elastic().time_step_limit() < rigid().time_step_limit() ? elastic() : rigid();
  }
  /// How many of `particles`, of which those of the elastic part come first, are of that part.
  std::size_t count_of_elastic(const std::vector<std::uint32_t>& particles) const;
  /// Each part's share of them, numbered as the part does.
  std::array<std::vector<std::uint32_t>, 2> shares(const std::vector<std::uint32_t>& particles) const;

  std::array<std::unique_ptr<SolidModel>, 2> parts_;  ///< elastic, rigid
  Timers timers_;
};

}  // namespace toryu::solid
