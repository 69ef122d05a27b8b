#include "solid_solver/terms/body_contact.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"

namespace toryu::solid {
namespace {

/// Two blocks of 4 x 4 particles, 5 mm apart, `gap` between their faces, that move towards each other.
Parameters two_blocks(double gap, double speed) {
  Parameters p = free_plate(4);
  const auto moving = [](double v) { return InitialVelocity{.velocity = Vec(v, 0)}; };
  p.regions = {{.name = "left",
                .box = {Vec(-0.02, 0), Vec(0, 0.02)},
                .initial_velocity = moving(speed),
                .observed = true},
               {.name = "right",
                .box = {Vec(gap, 0.003), Vec(gap + 0.02, 0.023)},
                .initial_velocity = moving(-speed),
                .observed = true}};
  p.body_contact = Contact{.stiffness = 0.5};
  return p;
}

TEST(BodyContact, PushesByTheGradientOfItsEnergyEqualAndOpposite) {
  const Parameters p = two_blocks(0.009, 0);
  const Body body = body_of(p);
  const std::size_t count = body.size(), size = padded(count);
  VecField x, a;
  Field V(size, body.volume(0)), inverse_rho(size, 1.0 / p.material.density);
  resize(x, size);
  resize(a, size);
  for (std::size_t i = 0; i < count; ++i) set(x, i, body.X[i]);
  const TouchingBodies bodies(x, V, count, *p.body_contact, p.material, p.spacing, p.h());
  TouchingBodies::State state;
  EXPECT_EQ(bodies.body_count(), 2u);
  bodies.push(state, x, inverse_rho, a);
  EXPECT_EQ(bodies.energy(state), 0) << "apart";

  for (std::size_t i = 16; i < count; ++i) x[0][i] -= 0.0115;  // 2.5 mm into each other
  resize(a, size);
  for (auto& component : a) std::fill(component.begin(), component.end(), 0.0);
  bodies.push(state, x, inverse_rho, a);
  ASSERT_GT(bodies.energy(state), 0);
  Vec sum = Vec::Zero();
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    sum += at(a, i);
    largest = std::max(largest, at(a, i).norm());
  }
  EXPECT_LT(sum.norm(), 1e-12 * largest);
  const double mass = p.material.density * V[0], step = 1e-8;
  for (const std::size_t i : {std::size_t{3}, std::size_t{7}, std::size_t{16}, std::size_t{20}})
    for (int axis = 0; axis < dim; ++axis) {
      VecField moved = x, unused = a;
      moved[axis][i] += step;
      bodies.push(state, moved, inverse_rho, unused);
      const double ahead = bodies.energy(state);
      moved[axis][i] -= 2 * step;
      bodies.push(state, moved, inverse_rho, unused);
      EXPECT_NEAR(-(ahead - bodies.energy(state)) / (2 * step), mass * at(a, i)[axis], 1e-5 * mass * largest);
    }
}

TEST(BodyContact, BodiesBounceAndKeepMomentumAndEnergy) {
  const auto model = model_of(two_blocks(0.009, 1.0));
  const double energy = observed(*model, "kinetic_energy");
  run_to(*model, 0.02);
  EXPECT_LT(observed(*model, "left_velocity_x"), -0.5) << "it came back";
  EXPECT_NEAR(observed(*model, "left_velocity_x"), -observed(*model, "right_velocity_x"), 1e-12);
  EXPECT_EQ(observed(*model, "contact_energy"), 0) << "and left";
  EXPECT_NEAR(observed(*model, "dissipated_energy") / energy, 0, 0.02);
}

}  // namespace
}  // namespace toryu::solid
