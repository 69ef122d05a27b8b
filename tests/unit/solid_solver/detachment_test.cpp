#include "solid_solver/detachment.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"

namespace toryu::solid {
namespace {

/// 16 x 4 particles, 5 mm apart, the first column held.
Parameters held_plate() {
  Parameters p = free_plate(4);
  p.clamps = {{"root", {Vec(-1, -1), Vec(p.spacing, 1)}}};
  p.detachment = Detachment{};
  return p;
}

double count(const std::vector<char>& flags) {
  return static_cast<double>(std::count(flags.begin(), flags.end(), 1));
}

TEST(DetachmentObserver, FindsAllThatNoChainJoinsToAClamp) {
  const Parameters p = held_plate();
  const Body body = body_of(p);
  const DetachmentObserver observer(body, p);
  auto state = observer.start();
  EXPECT_FALSE(observer.record(state, body.X, 0));
  EXPECT_EQ(count(state.detached), 0);

  // The outer half moves away: from a column to the next were 5 mm, and 2h = 13 mm hold.
  auto x = body.X;
  const auto part_by = [&](double gap) {
    for (std::size_t i = 0; i < body.size(); ++i)
      x[i] = body.X[i] + (body.X[i][0] > 0.04 ? Vec(gap, 0) : Vec(0, 0));
  };
  part_by(0.0079);
  EXPECT_FALSE(observer.record(state, x, 0.5));
  part_by(0.0081);
  EXPECT_TRUE(observer.record(state, x, 0.75));
  EXPECT_EQ(count(state.detached), 32);

  // Dated once, even if it comes back and leaves again.
  part_by(0);
  EXPECT_FALSE(observer.record(state, x, 1.0));
  EXPECT_EQ(count(state.detached), 0);
  part_by(0.1);
  EXPECT_FALSE(observer.record(state, x, 1.25));
  ASSERT_EQ(state.list.size(), 32u);
  for (const auto& particle : state.list) {
    EXPECT_EQ(particle.time, 0.75);
    EXPECT_DOUBLE_EQ(particle.mass, 1000 * 0.005 * 0.005);
    EXPECT_GT(particle.start[0], 0.04);
    EXPECT_NEAR((particle.position - particle.start)[0], 0.0081, 1e-15);
  }
}

TEST(DetachmentObserver, AChainOfSingleParticlesHolds) {
  Parameters p = held_plate();
  p.detachment->bond_length = 1.1;
  p.regions = {{"root", {Vec(0, 0), Vec(0.02, 0.02)}},
               {"bridge", {Vec(0.02, 0.005), Vec(0.04, 0.01)}},
               {"block", {Vec(0.04, 0), Vec(0.06, 0.02)}}};
  const Body body = body_of(p);
  const DetachmentObserver observer(body, p);
  auto state = observer.start();
  observer.record(state, body.X, 0);
  EXPECT_EQ(count(state.detached), 0);
  auto x = body.X;
  x[17] += Vec(0, 0.02);  // of the bridge's four
  EXPECT_TRUE(observer.record(state, x, 1e-3));
  EXPECT_EQ(count(state.detached), 1 + 2 + 16) << "the particle, the rest of the bridge, and the block";
}

TEST(DetachmentObserver, SearchesAtWholeIntervals) {
  const Parameters p = held_plate();
  const Body body = body_of(p);
  const DetachmentObserver observer(body, p);
  auto state = observer.start();
  EXPECT_EQ(state.next, 0);
  observer.record(state, body.X, 0);
  EXPECT_EQ(state.next, 1e-3);
  observer.record(state, body.X, 1.4e-3);
  EXPECT_EQ(state.next, 2e-3);
}

TEST(Detachment, AStruckPlateTearsAndTheModelRecordsWhatCameOff) {
  Parameters p = held_plate();
  p.formulation = Formulation::updated_lagrangian;
  p.hourglass.reset();
  p.artificial_viscosity = ArtificialViscosity{};
  p.initial_velocity = InitialVelocity{.velocity = Vec(40, 0)};
  p.limits.strain = 100;
  const auto model = model_of(p);
  std::vector<DetachedParticle> recorded;
  model->record_detached([&](const auto& all) { recorded = all; });
  EXPECT_EQ(observed(*model, "detached_particles"), 0);
  run_to(*model, 8e-3);
  EXPECT_TRUE(recorded.empty()) << "a window that may be repeated is not recorded";
  model->accept();
  EXPECT_GT(observed(*model, "largest_stretch"), 2.6);
  const double number = observed(*model, "detached_particles");
  EXPECT_GE(number, 32);
  EXPECT_NEAR(observed(*model, "detached_mass"), number * 0.025, 1e-12);
  ASSERT_GE(recorded.size(), number);
  for (std::size_t n = 1; n < recorded.size(); ++n) EXPECT_LE(recorded[n - 1].time, recorded[n].time);
  EXPECT_GT(recorded.front().time, 1e-3);
  const Frame frame = model->frame();
  const auto field = std::find_if(frame.fields.begin(), frame.fields.end(),
                                  [](const auto& f) { return f.name == "detached"; });
  ASSERT_NE(field, frame.fields.end());
  EXPECT_EQ(std::count(field->values.begin(), field->values.end(), 1.0), number);
}

}  // namespace
}  // namespace toryu::solid
