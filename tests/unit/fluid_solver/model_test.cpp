// A second model of the fluid, as small as one can be: particles that fall and do not meet. All else that a
// fluid does (walls, checks, observers, frames, checkpoints) is there without a word about it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

class FreeFall final : public FluidModel {
 public:
  using FluidModel::FluidModel;

  double time_step_limit() const override { return 0.01; }
  std::string_view time_step_rule() const override { return "given"; }
  void advance(double dt) override {
    update_neighbours(dt);
    for (std::size_t i = 0; i < state_.fluid.count; ++i) {
      const Vec v = at(state_.fluid.v, i) + dt * scene_.gravity;
      set(state_.fluid.v, i, v);
      set(state_.fluid.x, i, at(state_.fluid.x, i) + dt * v);
    }
    state_.time += dt;
    move_boundaries(state_.time);
  }
  std::vector<ActiveTerm> active_terms() const override {
    return {{"free fall", "Dv/Dt = g", "Galilei 1638", ""}};
  }
  std::vector<Power> powers() override { return {}; }
};

Setting falling() {
  Setting setting = collapsing_column();
  setting.scene.walls[1].motion = Motion{{{0, 0.5, 0}}};
  Observer& front = setting.parameters.observers.emplace_back();
  front.name = "front";
  front.quantity = Quantity::front_x;
  return setting;
}

double observed(const FluidModel& model, const std::string& name) {
  for (const auto& told : model.observe())
    if (told.name == name) return told.value;
  return std::nan("");
}

TEST(ASecondModel, HasAllThatModelsShare) {
  const Setting setting = falling();
  FreeFall model(setting.parameters, setting.scene);
  for (int n = 0; n < 10; ++n) model.advance(0.01);
  EXPECT_NEAR(observed(model, "momentum_y"), -0.1 * 9.81 * 1000 * 0.4, 1e-9);
  EXPECT_NEAR(observed(model, "front"), 0.5, 1e-12);
  EXPECT_EQ(model.frame().fields.size(), 4u);
  for (const Boundary& wall : model.boundaries()) EXPECT_EQ(wall.v[0][0], wall.name == "left" ? 0.5 : 0.0);
  model.check(model.time());
  while (model.time() < 1.6) model.advance(0.05);
  EXPECT_THROW(model.check(model.time()), PhysicsFailure) << "it has fallen out of the domain";
}

TEST(ASecondModel, GoesOnFromACheckpoint) {
  const Setting setting = falling();
  FreeFall model(setting.parameters, setting.scene), other(setting.parameters, setting.scene);
  for (int n = 0; n < 10; ++n) model.advance(0.01);
  std::stringstream stream;
  model.write_state(stream);
  other.read_state(stream);
  for (int n = 0; n < 10; ++n) {
    model.advance(0.01);
    other.advance(0.01);
  }
  EXPECT_EQ(model.frame().positions, other.frame().positions);
}

}  // namespace
}  // namespace toryu::fluid
