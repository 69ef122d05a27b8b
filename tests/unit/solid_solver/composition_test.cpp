/// What a body of several materials comes to: laminates at their interface, energy and momentum, and bodies
/// that do not know of each other.
#include "solid_solver/total_lagrangian/composition.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "samples.hpp"

namespace toryu::solid {
namespace {

/// A block of 12 x 12 particles whose upper or right half is stiffer; E = 2 MPa and 20 MPa.
Parameters two_layers(int axis, double nu = 0.3) {
  Parameters p;
  p.material = {.density = 1000, .youngs_modulus = 2e6, .poissons_ratio = nu};
  p.materials = {{.name = "stiff", .elastic = {2500, 2e7, nu}}};
  p.spacing = 0.01;
  Vec half(0.12, 0.12);
  half[axis] = 0.06;
  p.regions = {{"soft", {Vec(0, 0), half}},
               {.name = "hard", .box = {0.06 * Vec::Unit(axis), Vec(0.12, 0.12)}, .material = "stiff"}};
  p.hourglass = HourglassPenalty{};
  return p;
}

/// The parts of the total form, as it puts them together, in the order of the particles' numbers.
struct Parts {
  explicit Parts(const Parameters& p) : body(body_of(p)) {
    const std::size_t size = padded(body.size());
    resize(X, size), resize(cells, size);
    volume.resize(size), mobile.assign(size, 1.0);
    for (std::uint32_t i = 0; i < body.size(); ++i) X_of.push_back(body.X[i]);
    VecField unsorted;
    resize(unsorted, size);
    for (std::size_t i = 0; i < body.size(); ++i) set(unsorted, i, body.X[i]);
    number = StripOrder(width).sort(unsorted[0], unsorted[1], body.size());
    for (std::size_t k = 0; k < size; ++k) {
      const std::uint32_t i = number[std::min(k, body.size() - 1)];
      set(X, k, body.X[i]), set(cells, k, body.cell[i]);
      volume[k] = body.volume(i);
    }
    pairs.emplace(X, volume, body.size(), p.h(), width, Held{mobile, cells}, body.shape, body.shifts);
    composition.emplace(p, body, number, size);
    composition->find_laminates(X, body.size(), {mobile, cells}, volume, *pairs, 2 * p.h());
  }
  Tensor<double> gradient(const VecField& u, std::size_t k) const {
    Tensor<Lanes> H;
    pairs->displacement_gradient(u, k / lane_count, H);
    const std::size_t lane = k % lane_count;
    return {H[0][lane], H[1][lane], H[2][lane], H[3][lane]};
  }

  Body body;
  double width = 0.01 * std::sqrt(static_cast<double>(lane_count));
  std::vector<std::uint32_t> number;
  std::vector<Vec> X_of;
  VecField X, cells;
  Field volume, mobile;
  std::optional<ReferencePairs> pairs;
  std::optional<Composition> composition;
};

TEST(Composition, SeesTheStrainOfItsOwnSideOfAnInterface) {
  // Pulled along y across layers: u_y has a kink, and the stress M du_y/dy is one.
  const Parts parts(two_layers(1));
  const double soft = 1e-7, hard = 0.1 * soft;
  VecField u;
  resize(u, parts.X[0].size());
  for (std::size_t k = 0; k < u[0].size(); ++k) {
    const double y = parts.X[1][k];
    u[1][k] = y < 0.06 ? soft * y : soft * 0.06 + hard * (y - 0.06);
  }
  std::size_t seen = 0;
  for (const auto& laminate : parts.composition->laminates()) {
    const Vec X = at(parts.X, laminate.slot);
    EXPECT_NEAR(std::abs(laminate.normal[1]), 1, 1e-12);
    if (X[0] < 0.03 || X[0] > 0.09) continue;  // beside a side H is not symmetric
    ++seen;
    const Tensor<double> mean = parts.gradient(u, laminate.slot),
                         own = parts.composition->own_gradient(laminate.slot, mean);
    EXPECT_GT(std::abs(mean[3] - (X[1] < 0.06 ? soft : hard)), 0.01 * hard) << "what the mean is off by";
    EXPECT_NEAR(own[3], X[1] < 0.06 ? soft : hard, 1e-6 * hard);
    const Tensor<double> of_soft = parts.composition->own_gradient(laminate.slot, {0, 0, 0, 0});
    EXPECT_EQ(of_soft[3], 0);
  }
  EXPECT_EQ(seen, 6u * 4u) << "two rows on either side";
}

TEST(Composition, SharesHalfTheKinkOfWhatLiesOnTheInterfaceByHand) {
  // By hand: h/d = 1.3, support 2.6 d, the pairs of a row half a spacing off whose partner lies beyond. With
  // w = -W'/R, phi is sum w (y_j - d/2) y_j over the j beyond, over sum w y_j^2 over all.
  const Parts parts(two_layers(1));
  const CubicSpline W(0.013);
  double beyond = 0, all = 0;
  for (int m = -2; m <= 2; ++m)
    for (int n = -2; n <= 2; ++n) {
      const double x = 0.01 * m, y = 0.01 * n, r = std::hypot(x, y);
      if (r == 0) continue;
      const double w = -W.gradient_over_r(r, 1 / r);
      all += w * y * y;
      if (n > 0) beyond += w * (y - 0.005) * y;
    }
  for (const auto& laminate : parts.composition->laminates()) {
    const Vec X = at(parts.X, laminate.slot);
    if (std::abs(X[1] - 0.06) < 0.009 && X[0] > 0.03 && X[0] < 0.09) {
      EXPECT_NEAR(laminate.share, beyond / all, 1e-9);
    }
  }
}

TEST(Composition, HasStressThatIsTheDerivativeOfItsEnergy) {
  const Parts parts(two_layers(0));
  for (const auto& laminate : parts.composition->laminates()) {
    const std::size_t cluster = laminate.slot / lane_count, lane = laminate.slot % lane_count;
    const Tensor<double> H{0.05, 0.3, -0.25, -0.04};  // turned and strained
    Tensor<Lanes> of_cluster;
    for (std::size_t n = 0; n < H.size(); ++n) of_cluster[n] = H[n];
    const Tensor<Lanes> P = parts.composition->stress(cluster, of_cluster);
    for (std::size_t n = 0; n < H.size(); ++n) {
      Tensor<double> ahead = H, behind = H;
      ahead[n] += 1e-6, behind[n] -= 1e-6;
      const double slope = (parts.composition->energy(laminate.slot, ahead) -
                            parts.composition->energy(laminate.slot, behind)) /
                           2e-6;
      EXPECT_NEAR(P[n][lane], slope, 1e-3 * 1e3) << n;
    }
  }
}

TEST(Composition, KeepsEnergyAndMomentaOfABondedBody) {
  Parameters p = two_layers(1);
  p.initial_velocity = InitialVelocity{
      .profile = VelocityProfile::linear, .velocity = Vec(1, 2), .gradient = {{3.0, -8.0}, {12.0, -5.0}}};
  const auto model = model_of(p);
  const Vec first(observed(*model, "momentum_x"), observed(*model, "momentum_y"));
  EXPECT_NEAR(first[0], 0.5 * 0.0144 * (1000 * (1 + 3 * 0.06 - 8 * 0.03) + 2500 * (1 + 3 * 0.06 - 8 * 0.09)),
              1e-9);
  const double turn = angular_momentum(*model), energy = observed(*model, "kinetic_energy");
  double worst = 0;
  for (int n = 0; n < 400; ++n) {
    model->advance(0.25 * model->time_step_limit());
    if (n % 20 == 0) worst = std::max(worst, std::abs(observed(*model, "dissipated_energy")));
  }
  EXPECT_GT(observed(*model, "elastic_energy"), 0.003 * energy);
  EXPECT_LT(worst, 1e-4 * energy);
  EXPECT_NEAR(observed(*model, "momentum_x"), first[0], 1e-12 * std::abs(first[1]));
  EXPECT_NEAR(observed(*model, "momentum_y"), first[1], 1e-12 * std::abs(first[1]));
  EXPECT_NEAR(angular_momentum(*model), turn, 1e-10 * std::abs(turn));
}

TEST(Composition, KeepsMomentumUnderViscosityBetweenMaterials) {
  Parameters p = two_layers(1);
  p.artificial_viscosity = ArtificialViscosity{};
  p.regions[1].initial_velocity = InitialVelocity{.velocity = Vec(0.5, -2)};
  const auto model = model_of(p);
  const double first = observed(*model, "momentum_y");
  run_to(*model, 2e-3);
  EXPECT_NEAR(observed(*model, "momentum_y"), first, 1e-12 * std::abs(first));
  EXPECT_GT(observed(*model, "dissipated_energy"), 0);
}

/// A cantilever in its first mode, of the material that is named, standing at y = `level` [m].
Region beam(const std::string& material, double level) {
  return {
      .name = "beam of " + material, .box = {Vec(0, level), Vec(0.08, level + 0.02)}, .material = material};
}
Parameters beams(const std::vector<Region>& regions) {
  Parameters p = moving_cantilever(4, 0.5);
  p.materials = {{.name = "light", .elastic = {400, 3e6, 0.2}},
                 {.name = "rubber", .law = ElasticLaw::neo_hookean, .elastic = {1500, 1e6, 0.45}}};
  p.regions = regions;
  p.artificial_viscosity = ArtificialViscosity{};
  return p;
}

TEST(Composition, LetsBodiesThatDoNotTouchMoveAsEachDoesAlone) {
  const Region lower = beam("light", 0), upper = beam("rubber", 0.1);
  const auto both = model_of(beams({lower, upper})), first = model_of(beams({lower})),
             second = model_of(beams({upper}));
  EXPECT_NEAR(both->time_step_limit(), std::min(first->time_step_limit(), second->time_step_limit()),
              0.02 * both->time_step_limit());
  for (int n = 0; n < 60; ++n)
    for (auto* model : {both.get(), first.get(), second.get()}) model->advance(5e-5);
  const std::size_t count = first->particle_count();
  for (std::size_t i = 0; i < count; ++i) {  // of several materials sums are put together otherwise
    EXPECT_LT((both->displacement(i) - first->displacement(i)).norm(), 1e-15) << i;
    EXPECT_LT((both->displacement(count + i) - second->displacement(i)).norm(), 1e-15) << i;
    EXPECT_NEAR(both->stress(count + i).xx, second->stress(i).xx, 1e-9 * 3e4) << i;
  }
  EXPECT_GT(first->displacement(count - 1).norm(), 1e-4);
}

TEST(Composition, LetsNoBodyFeelOneThatItDoesNotTouch) {
  Region still = beam("rubber", 0.03);  // half its thickness away
  const auto moving = model_of(beams({beam("light", 0), still}));
  still.initial_velocity = InitialVelocity{};
  const auto resting = model_of(beams({beam("light", 0), still}));
  for (int n = 0; n < 60; ++n)
    for (auto* model : {moving.get(), resting.get()}) model->advance(5e-5);
  const std::size_t count = moving->particle_count() / 2;
  for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(moving->displacement(i), resting->displacement(i)) << i;
  EXPECT_GT(moving->displacement(2 * count - 1).norm(), 1e-4);
  EXPECT_EQ(resting->displacement(2 * count - 1).norm(), 0);
}

TEST(Composition, KeepsMomentumAndEnergyWhereBodiesOfTwoMaterialsCollide) {
  Parameters p = two_layers(0);
  p.regions[1].box = {Vec(0.061, 0), Vec(0.121, 0.12)};  // a millimetre apart
  p.regions[0].initial_velocity = InitialVelocity{.velocity = Vec(1, 0)};
  p.body_contact = Contact{.stiffness = 0.5};
  const auto model = model_of(p);
  const double first = 0.06 * 0.12 * 1000 * 1;
  EXPECT_NEAR(observed(*model, "momentum_x"), first, 1e-12 * first);
  double pressed = 0;
  while (model->velocity(model->particle_count() - 1)[0] < 0.1) {
    model->advance(0.5 * model->time_step_limit());
    pressed = std::max(pressed, observed(*model, "contact_energy"));
    ASSERT_LT(model->displacement(0)[0], 0.1) << "the bodies pass through each other";
  }
  EXPECT_GT(pressed, 0);
  EXPECT_NEAR(observed(*model, "momentum_x"), first, 1e-12 * first);
  EXPECT_NEAR(observed(*model, "dissipated_energy"), 0, 2e-3 * 0.5 * first);
}

TEST(Composition, FramesSayWhatAParticleIsMadeOf) {
  const auto both = model_of(beams({beam("light", 0), beam("rubber", 0.1)}));
  for (const auto& field : both->frame().fields) {
    if (field.name != "material") continue;
    EXPECT_EQ(field.values.front(), 1);
    EXPECT_EQ(field.values.back(), 2);
    return;
  }
  ADD_FAILURE() << "no field 'material'";
}

}  // namespace
}  // namespace toryu::solid
