/// A window that is repeated, and a run that goes on from a checkpoint, are the same bit by bit: both
/// formulations, both integrators and every term that keeps something, with lists that are built anew before
/// and after.
#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <sstream>

#include "samples.hpp"

namespace toryu::solid {
namespace {

constexpr int steps_of_window = 45;

struct Sample {
  std::string name;
  Parameters p;
  Scene scene = empty_scene();
};
void PrintTo(const Sample& sample, std::ostream* out) {
  *out << sample.name;
}

/// 13 x 5 particles of two masses, which leaves lanes idle, about 5 mm apart. They stretch and turn by
/// several metres a second.
Sample moving_block(const std::string& name, Formulation formulation, Integrator integrator) {
  Sample sample{name, free_plate(4)};
  sample.p.formulation = formulation;
  sample.p.integrator = integrator;
  if (formulation == Formulation::updated_lagrangian) sample.p.hourglass.reset();
  sample.p.regions = {{"block", {Vec(0, 0), Vec(0.045, 0.025)}}, {"tip", {Vec(0.045, 0), Vec(0.066, 0.025)}}};
  sample.p.clamps = {{"root", {Vec(-1, -1), Vec(0.005, 1)}}};
  sample.p.initial_velocity = InitialVelocity{.profile = VelocityProfile::linear,
                                              .velocity = Vec(4, -3),
                                              .gradient = {{100.0, -50.0}, {150.0, -50.0}}};
  sample.p.limits.strain = 100;
  sample.scene.gravity = Vec(1, -10);
  return sample;
}

using Change = std::pair<std::string, std::function<void(Sample&)>>;

const std::vector<Change>& terms_of_both_forms() {
  static const std::vector<Change> changes{
      {"plain", [](Sample&) {}},
      {"viscous", [](Sample& s) { s.p.artificial_viscosity = ArtificialViscosity{}; }},
      {"damped", [](Sample& s) { s.p.damping = Damping{.rate = 300}; }},
      {"walls",
       [](Sample& s) {
         s.p.wall_contact = Contact{};
         s.scene.walls = {{"floor", {Vec(-0.05, -0.03), Vec(0.12, -0.0005)}, {}},
                          {"ram",
                           {Vec(0.02, 0.028), Vec(0.05, 0.045)},
                           Motion{.velocity = {{0.0, 0.5, -5.0}, {2e-3, 0.0, 0.0}}}}};
       }},
      {"detaching",
       [](Sample& s) {
         s.p.detachment = Detachment{.bond_length = 1.07, .interval = 1e-4};
         s.p.initial_velocity->velocity = Vec(30, -3);
       }},
      {"bonds", [](Sample& s) { s.p.bonds = BondLimits{.torn_at = 1.01, .clumped_at = 0.99}; }}};
  return changes;
}

const std::vector<Change>& terms_of_total_form() {
  static const std::vector<Change> changes{
      {"materials",
       [](Sample& s) {
         s.p.materials = {{.name = "stiff", .elastic = {3000, 8e6, 0.2}}};
         s.p.regions[1].material = "stiff";
         s.p.artificial_viscosity = ArtificialViscosity{};
       }},
      {"bodies",
       [](Sample& s) {
         s.p.body_contact = Contact{};
         s.p.regions.push_back({.name = "other",
                                .box = {Vec(0.07, 0), Vec(0.085, 0.025)},
                                .initial_velocity = InitialVelocity{.velocity = Vec(-20, 1)},
                                .observed = true});
       }},
      {"driven",
       [](Sample& s) {
         s.p.loads = {{.name = "pull",
                       .box = {Vec(0.05, 0), Vec(0.07, 0.02)},
                       .force = Vec(3e3, 1e3),
                       .factor = {{0, 0}, {1e-3, 1}},
                       .sine = {{{.amplitude = 1, .frequency = 500}}}}};
         s.p.clamps[0].motion =
             Motion{.velocity = {{0, 3, 1}},
                    .rotation = Rotation{Vec(0, 0.01), {.angular_velocity = {{0, 50}, {1e-3, 200}}}}};
         s.scene.gravity_change = GravityChange{.acceleration = {{0, 0, 0}, {1e-3, 500, -900}}};
       }},
      {"rubber", [](Sample& s) { s.p.yeoh = Yeoh{.c_10 = 3e5, .bulk_modulus = 3e6}; }}};
  return changes;
}

const std::vector<Change>& terms_of_updated_form() {
  static const std::vector<Change> changes{
      {"stressed",
       [](Sample& s) {
         s.p.artificial_viscosity = ArtificialViscosity{};
         s.p.artificial_stress = ArtificialStress{};
       }},
      {"renormalised", [](Sample& s) { s.p.gradients = Gradients::renormalised; }}};
  return changes;
}

/// A rigid one with all that it may have.
Sample rigid_block() {
  Sample sample = moving_block("rigid", Formulation::rigid, Integrator::midpoint);
  for (const auto& [name, change] : terms_of_both_forms())
    if (name == "walls") change(sample);
  sample.p.wall_contact->modulus = 1e6;
  sample.p.hourglass.reset();
  sample.p.clamps.clear();
  sample.p.initial_velocity->gradient = {{0, -100}, {100, 0}};
  sample.p.mounting = Mounting{.stiffness = Vec(1e4, 3e4), .damping = Vec(20, 50), .rest_angle = 1};
  sample.p.loads = {{.name = "pull",
                     .box = {Vec(0.05, 0), Vec(0.07, 0.02)},
                     .force = Vec(3e3, 1e3),
                     .sine = {{{.amplitude = 1, .frequency = 500}}}}};
  sample.scene.gravity_change = GravityChange{.acceleration = {{0, 0, 0}, {1e-3, 500, -900}}};
  return sample;
}

/// Two of them, each a body that is held in its own way.
Sample rigid_blocks() {
  Sample sample = rigid_block();
  sample.name = "rigid_bodies";
  Parameters& p = sample.p;
  p.bodies = {{"left", p.mounting}, {"right"}};
  p.mounting.reset();
  p.loads[0].box = {Vec(0.02, 0), Vec(0.04, 0.02)};
  p.materials = {{.name = "heavy", .elastic = {2000, 0, 0}}};
  p.regions = {
      {.name = "block", .box = {Vec(0, 0), Vec(0.045, 0.025)}, .body = "left"},
      {.name = "other", .box = {Vec(0.08, 0), Vec(0.1, 0.025)}, .material = "heavy", .body = "right"}};
  return sample;
}

/// Each form with each term alone, and with all of its terms together.
std::vector<Sample> samples() {
  const std::tuple<const char*, Formulation, Integrator> forms[] = {
      {"total", Formulation::total_lagrangian, Integrator::midpoint},
      {"midpoint", Formulation::updated_lagrangian, Integrator::midpoint},
      {"symplectic", Formulation::updated_lagrangian, Integrator::symplectic}};
  std::vector<Sample> all{rigid_block(), rigid_blocks()};
  for (const auto& [form, formulation, integrator] : forms) {
    auto changes = terms_of_both_forms();
    const auto& own =
        formulation == Formulation::total_lagrangian ? terms_of_total_form() : terms_of_updated_form();
    changes.insert(changes.end(), own.begin(), own.end());
    Sample together = moving_block(std::string(form) + "_all", formulation, integrator);
    for (const auto& [term, change] : changes) {
      change(all.emplace_back(moving_block(std::string(form) + "_" + term, formulation, integrator)));
      change(together);
    }
    // All at once tear the block: with steps of 0.8 it ends beyond all numbers on some processors.
    if (formulation == Formulation::total_lagrangian) together.p.time_step_share = 0.4;
    all.push_back(together);
  }
  return all;
}

class EachTerm : public testing::TestWithParam<Sample> {};
INSTANTIATE_TEST_SUITE_P(Solid, EachTerm, testing::ValuesIn(samples()),
                         [](const auto& sample) { return sample.param.name; });

/// Takes a window under a load that depends on `kind`.
void advance(SolidModel& model, int kind, int steps = steps_of_window) {
  const auto touched = model.interface(0.011).id;
  InterfaceLoad load;
  for (std::size_t n = 0; n < touched.size(); ++n) {
    const double share = static_cast<double>(n % 7) - 3.0;
    load.pressure.push_back(0);
    load.force.insert(load.force.end(), {0.3 * share + kind, -1.0 - 0.5 * kind});
    load.friction_force.insert(load.friction_force.end(), {0.01 * kind, 0.02 * share});
  }
  model.set_interface_load(touched, load);
  for (int n = 0; n < steps; ++n) model.advance(model.time_step_limit());
}

std::string checkpoint(const SolidModel& model) {
  std::ostringstream stream;
  model.write_state(stream);
  return stream.str();
}

/// Every number that the model shows, bit by bit and by name.
using Shown = std::vector<std::pair<std::string, std::uint64_t>>;
Shown shown(const SolidModel& model) {
  Shown all;
  const auto append = [&](const std::string& name, double value) {
    all.emplace_back(name, std::bit_cast<std::uint64_t>(value));
  };
  std::vector<std::uint32_t> particles(model.particle_count());
  for (std::uint32_t i = 0; i < particles.size(); ++i) {
    particles[i] = i;
    for (const double value : model.acceleration(i)) append("acceleration", value);
  }
  const InterfaceMotion motion = model.motion(particles);
  for (const double value : motion.position) append("position", value);
  for (const double value : motion.velocity) append("velocity", value);
  for (const auto& observation : model.observe()) append(observation.name, observation.value);
  for (const auto& field : model.frame().fields)
    for (const double value : field.values) append(field.name, value);
  for (const auto& [name, value] : model.figures()) append(name, value);
  append("time step limit", model.time_step_limit());
  append("stored energy", model.health().potential_energy);
  const Impulses& impulses = model.impulses();
  for (const Vec& impulse : {impulses.loads, impulses.walls, impulses.clamps})
    for (const double value : impulse) append("impulse", value);
  return all;
}

/// Fails with the names of what differs.
void expect_same(const Shown& a, const Shown& b) {
  ASSERT_EQ(a.size(), b.size());
  std::map<std::string, int> differing;
  for (std::size_t n = 0; n < a.size(); ++n)
    if (a[n] != b[n]) ++differing[a[n].first];
  for (const auto& [name, count] : differing) ADD_FAILURE() << count << " values differ of: " << name;
}

long searches(const SolidModel& model) {
  for (const auto& part : model.timers().parts())
    if (part.name == "neighbour search") return part.calls;
  return 0;
}

/// That the sample does what it is meant to try.
void expect_at_work(const Sample& sample, const SolidModel& model) {
  if (sample.p.wall_contact) {
    EXPECT_GT(model.impulses().walls.norm(), 0);
  }
  if (sample.p.body_contact) {
    EXPECT_GT(observed(model, "other_velocity_x"), -15) << "it began with -20";
  }
  if (sample.p.detachment) {
    EXPECT_GT(observed(model, "detached_particles"), 0);
  }
  if (sample.p.bonds) {
    EXPECT_GT(model.figures()[0].second, 0) << "torn bonds";
  }
}

TEST_P(EachTerm, ARepeatedWindowIsTheFirst) {
  const auto model = model_of(GetParam().p, GetParam().scene);
  advance(*model, 1);
  const long before = searches(*model);
  model->save();
  const Shown start = shown(*model);
  const std::string written = checkpoint(*model);
  advance(*model, 2);
  const Shown first = shown(*model);
  const std::string first_written = checkpoint(*model);
  expect_at_work(GetParam(), *model);
  if (GetParam().p.formulation == Formulation::updated_lagrangian) {
    EXPECT_GT(before, 1);
    EXPECT_GT(searches(*model), before) << "lists were built anew within the window";
  }
  for (int repeat = 0; repeat < 2; ++repeat) {
    advance(*model, 3 + repeat, 20);
    model->restore();
    expect_same(shown(*model), start);
    EXPECT_EQ(checkpoint(*model), written);
    advance(*model, 2);
    expect_same(shown(*model), first);
    EXPECT_EQ(checkpoint(*model), first_written);
  }
}

TEST_P(EachTerm, ARunGoesOnFromACheckpointAsIfItHadNeverEnded) {
  const auto model = model_of(GetParam().p, GetParam().scene);
  advance(*model, 1);
  // within a window, so that a load is there and the lists are some steps old
  for (int steps = 1; steps <= 4; steps += 3) {
    advance(*model, 2, 10 + steps);
    const auto restarted = model_of(GetParam().p, GetParam().scene);
    std::istringstream stream(checkpoint(*model));
    restarted->read_state(stream);
    expect_same(shown(*restarted), shown(*model));
    EXPECT_EQ(checkpoint(*restarted), checkpoint(*model));
    for (auto* each : {model.get(), restarted.get()}) each->advance(each->time_step_limit());
    EXPECT_EQ(checkpoint(*restarted), checkpoint(*model)) << "idle lanes included";
    for (int window = 0; window < 3; ++window) {
      for (auto* each : {model.get(), restarted.get()}) advance(*each, window);
      expect_same(shown(*restarted), shown(*model));
      if (HasFailure()) return;
    }
    EXPECT_EQ(checkpoint(*restarted), checkpoint(*model));
    restarted->save();
    const Shown saved = shown(*restarted);
    advance(*restarted, 3, 10);
    restarted->restore();
    expect_same(shown(*restarted), saved);
  }
}

TEST(Checkpoint, TakesAtMost150BytesAParticleWithEveryOneLoaded) {
  for (const auto formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian}) {
    Sample sample = moving_block("", formulation, Integrator::midpoint);
    sample.p.regions = {{"block", {Vec(0, 0), Vec(0.4, 0.125)}}};
    const auto model = model_of(sample.p);
    const auto bytes_a_particle = [&] {
      return static_cast<double>(checkpoint(*model).size()) / static_cast<double>(model->particle_count());
    };
    EXPECT_LT(bytes_a_particle(), formulation == Formulation::total_lagrangian ? 53 : 110);
    const auto touched = model->interface(1.0).id;
    EXPECT_EQ(touched.size(), model->particle_count());
    model->set_interface_load(touched, {.pressure = std::vector<double>(touched.size()),
                                        .force = std::vector<double>(dim * touched.size(), 1.0),
                                        .friction_force = {}});
    EXPECT_LT(bytes_a_particle(), 150);
  }
}

TEST(Checkpoint, WhatCameOffIsRecordedOnceMoreAsAWhole) {
  Sample sample = moving_block("", Formulation::updated_lagrangian, Integrator::midpoint);
  sample.p.detachment = Detachment{.bond_length = 1.07, .interval = 1e-4};
  sample.p.initial_velocity->velocity = Vec(30, -3);
  using Rows = std::vector<DetachedParticle>;
  Rows first;
  std::vector<Rows> again;
  const auto model = model_of(sample.p), restarted = model_of(sample.p);
  model->record_detached([&](const Rows& all) { first = all; });
  restarted->record_detached([&](const Rows& all) { again.push_back(all); });
  advance(*model, 1);
  model->accept();
  std::istringstream stream(checkpoint(*model));
  restarted->read_state(stream);
  restarted->accept();
  restarted->accept();
  ASSERT_EQ(again.size(), 2u) << "at the start, and after the state was read";
  EXPECT_TRUE(again[0].empty());
  EXPECT_GT(first.size(), 10u);
  ASSERT_EQ(again[1].size(), first.size());
  for (std::size_t n = 0; n < first.size(); ++n) {
    EXPECT_EQ(again[1][n].particle, first[n].particle);
    EXPECT_EQ(again[1][n].time, first[n].time);
    EXPECT_EQ(again[1][n].position, first[n].position);
  }
}

}  // namespace
}  // namespace toryu::solid
