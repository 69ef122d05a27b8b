// What a recorded side answers: as it was recorded, its mean over other windows, its motion between their
// ends.
#include "replay/recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/unit/coupler/scratch_folder.hpp"

namespace toryu::replay {
namespace {

using testing::DoubleEq;
using testing::DoubleNear;
using testing::HasSubstr;
using testing::Pointwise;
using Numbers = std::vector<double>;

/// Two particles that move along x as x(t) = t^3, recorded at t = 1, 3 and 4 s.
struct Recorded {
  explicit Recorded(bool with_impulse = true) {
    std::ofstream(folder.path / "case.toml") << "[case]\nend_time = 4\n";
    start.traits = {.reach = 0.3, .time_step_limit = 1, .density = 1000, .sound_speed = 20, .spacing = 0.1};
    start.interface = {.id = {3, 7},
                       .position = {0, 0, 0, 1},
                       .volume = {1, 1},
                       .area_vector = {-1, 0, -1, 0},
                       .mass = {2, 2},
                       .spacing = 1};
    start.motion = motion_at(0);
    ExchangeWriter writer(folder.path, start);
    double time = 0;
    for (const auto& [dt, pressure, force] :
         {std::tuple{1.0, 10.0, 1.0}, std::tuple{2.0, 40.0, 4.0}, std::tuple{1.0, 20.0, 2.0}}) {
      FluidAnswer fluid;
      fluid.load.pressure = {pressure, 2 * pressure};
      fluid.load.force = {force, 0, 2 * force, 0.5};
      fluid.load.work_of_impulse = 0.5 * dt;
      if (with_impulse) fluid.load.impedance = {force, 0, force, 0};
      fluid.time_step_limit = 1 + dt;
      fluid.health.kinetic_energy = force;
      SolidAnswer solid;
      solid.motion = motion_at(time + dt);
      if (with_impulse) solid.motion.impulse = {dt, 0, 2 * dt, 0};
      solid.motion.work_of_impulse = dt;
      writer.write({.number = 1, .iteration = 0, .time = time, .dt = dt}, fluid, solid);
      time += dt;
    }
    writer.complete();
  }

  static InterfaceMotion motion_at(double t) {
    return {{t * t * t, 0, t * t * t, 1}, {3 * t * t, 0, 3 * t * t, 0}};
  }
  Recording recording() const { return {folder.path, CaseFile(folder.path, {})}; }

  ScratchFolder folder;
  CouplingStart start;
};

std::string fault_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const BadInput& fault) {
    return fault.what();
  }
  return "";
}

TEST(Recording, KnowsWhatItIsOf) {
  const Recorded recorded;
  const auto recording = recorded.recording();
  EXPECT_EQ(recording.start().traits.reach, 0.3);
  EXPECT_EQ(recording.start().traits.spacing, 0.1);
  EXPECT_EQ(recording.start().interface.id, recorded.start.interface.id);
  EXPECT_EQ(recording.start().interface.area_vector, recorded.start.interface.area_vector);
  EXPECT_EQ(recording.start().interface.mass, recorded.start.interface.mass);
  EXPECT_EQ(recording.start().motion.position, recorded.start.motion.position);
}

TEST(Recording, AnswersARecordedWindowAsItWas) {
  const Recorded recorded;
  auto recording = recorded.recording();
  const Window second{.number = 2, .iteration = 0, .time = 1, .dt = 2};
  const FluidAnswer fluid = recording.fluid_over(second, {});
  EXPECT_EQ(fluid.load.pressure, (Numbers{40, 80}));
  EXPECT_EQ(fluid.load.force, (Numbers{4, 0, 8, 0.5}));
  EXPECT_EQ(fluid.load.impedance, (Numbers{4, 0, 4, 0}));
  EXPECT_TRUE(fluid.load.friction_force.empty());
  EXPECT_EQ(fluid.time_step_limit, 3);
  EXPECT_EQ(fluid.health.kinetic_energy, 4);
  const SolidAnswer solid = recording.solid_over(second, fluid.load);
  EXPECT_EQ(solid.motion.position, Recorded::motion_at(3).position);
  EXPECT_EQ(solid.motion.velocity, Recorded::motion_at(3).velocity);
  EXPECT_EQ(solid.motion.impulse, (Numbers{2, 0, 4, 0}));
  EXPECT_EQ(solid.motion.work_of_impulse, 2);
}

TEST(Recording, OfALoadKeepsItsImpulseOverOtherWindows) {
  const Recorded recorded;
  auto recording = recorded.recording();
  // half a second of the first window, all of the second, a quarter of the third
  const Window across{.number = 1, .iteration = 0, .time = 0.5, .dt = 2.75};
  const FluidAnswer fluid = recording.fluid_over(across, {});
  EXPECT_THAT(fluid.load.pressure[0], DoubleEq((0.5 * 10 + 2 * 40 + 0.25 * 20) / 2.75));
  EXPECT_THAT(fluid.load.force[0], DoubleEq((0.5 * 1 + 2 * 4 + 0.25 * 2) / 2.75));
  EXPECT_THAT(fluid.load.force[3], DoubleNear(0.5, 1e-15));
  EXPECT_THAT(fluid.load.impedance[0], DoubleEq((0.5 * 1 + 2 * 4 + 0.25 * 2) / 2.75));
  EXPECT_EQ(fluid.load.work_of_impulse, 0.5 * 0.5 + 1 + 0.25 * 0.5);
  EXPECT_EQ(fluid.time_step_limit, 2) << "that of the window in which it ends";
}

TEST(Recording, GivesBackTheImpulseThatItIsAskedFor) {
  const Recorded recorded;
  auto recording = recorded.recording();
  const Window first{.number = 1, .iteration = 0, .time = 0, .dt = 1};
  EXPECT_EQ(recording.fluid_over(first, {}).load.impulse_on_fluid, Vec(-3, -0.5));
  EXPECT_EQ(recording.fluid_over(first, {1, 2, 3, 4}).load.impulse_on_fluid, Vec(-7, -6.5));
}

TEST(Recording, OfAMotionIsExactForACubic) {
  const Recorded recorded;
  auto recording = recorded.recording();
  for (const double end : {0.25, 1.5, 2.0, 3.75}) {
    const Window window{.number = 1, .iteration = 0, .time = end - 0.25, .dt = 0.25};
    const SolidAnswer answer = recording.solid_over(window, {});
    EXPECT_THAT(answer.motion.position, Pointwise(DoubleNear(1e-12), Recorded::motion_at(end).position))
        << end;
    EXPECT_THAT(answer.motion.velocity, Pointwise(DoubleNear(1e-12), Recorded::motion_at(end).velocity))
        << end;
  }
}

TEST(Recording, OfAMotionGivesTheImpulseByShares) {
  const Recorded recorded;
  auto recording = recorded.recording();
  InterfaceLoad load;
  load.force = {3, 0, 0, 0};
  load.impedance = {1, 0, 1, 0};
  const SolidAnswer answer = recording.solid_over({.number = 1, .iteration = 0, .time = 0.5, .dt = 1}, load);
  EXPECT_THAT(answer.motion.impulse, Pointwise(DoubleEq(), Numbers{0.5 + 0.5, 0, 1 + 1, 0}));
  EXPECT_EQ(answer.motion.work_of_impulse, 0.5 + 0.5);
  EXPECT_EQ(answer.impulse_taken, Vec(3 + 1 + 2, 0)) << "what the load gives and the impulse";
}

TEST(Recording, MadeWithoutImpulseGivesNoneToASchemeThatAsks) {
  const Recorded recorded(false);
  auto recording = recorded.recording();
  const Window first{.number = 1, .iteration = 0, .time = 0, .dt = 1};
  EXPECT_TRUE(recording.fluid_over(first, {}).load.impedance.empty());
  EXPECT_TRUE(recording.solid_over(first, {}).motion.impulse.empty());
  InterfaceLoad load;
  load.impedance = {1, 0, 1, 0};
  EXPECT_EQ(recording.solid_over(first, load).motion.impulse, Numbers(4, 0.0));
}

TEST(Recording, ThatEndsTooSoonIsRefused) {
  const Recorded recorded;
  EXPECT_THAT(
      fault_of([&] { Recording(recorded.folder.path, CaseFile(recorded.folder.path, {"case.end_time=5"})); }),
      HasSubstr("exchange.h5: error: the record ends at t = 4 s, before case.end_time = 5 s"));
}

TEST(Recording, IsRefusedToAnotherInterface) {
  const Recorded recorded;
  const auto recording = recorded.recording();
  EXPECT_NO_THROW(recording.check(recorded.start.interface));
  Interface moved = recorded.start.interface;
  moved.position[2] += 0.01;
  EXPECT_THAT(fault_of([&] { recording.check(moved); }), HasSubstr("holds the load of 2 particles"));
  Interface fewer = recorded.start.interface;
  fewer.id.pop_back();
  fewer.position.resize(2);
  EXPECT_THAT(fault_of([&] { recording.check(fewer); }), HasSubstr("the solid has 1 on its interface"));
}

TEST(Recording, IsRefusedToAFluidThatReachesDeeper) {
  const Recorded recorded;
  const auto recording = recorded.recording();
  EXPECT_NO_THROW(recording.check_reach(0.3));
  EXPECT_NO_THROW(recording.check_reach(0.1));
  EXPECT_THAT(fault_of([&] { recording.check_reach(0.31); }), HasSubstr("this fluid reaches 0.31 m"));
}

/// Changes one number of a dataset in place.
void change(const std::filesystem::path& path, const char* name, std::vector<hsize_t> place, double value) {
  const HdfHandle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open it");
  const HdfHandle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose, name);
  const HdfHandle space(H5Dget_space(dataset), H5Sclose, name), one(H5Screate(H5S_SCALAR), H5Sclose, name);
  H5Sselect_elements(space, H5S_SELECT_SET, 1, place.data());
  ASSERT_GE(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, one, space, H5P_DEFAULT, &value), 0);
}

TEST(Recording, OfNoNumbersOrOfWindowsThatDoNotFollowIsRefused) {
  const Window second{.number = 2, .iteration = 0, .time = 1, .dt = 2};
  {
    const Recorded recorded;
    change(recorded.folder.path / "exchange.h5", "force", {1, 1, 0}, std::nan(""));
    auto recording = recorded.recording();
    EXPECT_THAT(fault_of([&] { recording.fluid_over(second, {}); }),
                HasSubstr("'force' of its window 1 holds what is no number"));
  }
  for (const auto& [name, value] : {std::pair{"window_length", -2.0}, std::pair{"window_start", 1.5}}) {
    const Recorded recorded;
    change(recorded.folder.path / "exchange.h5", name, {1}, value);
    EXPECT_THAT(fault_of([&] { recorded.recording(); }),
                HasSubstr("its window 1 does not begin where the one before ends, or has no length"));
  }
}

TEST(Recording, OfFewerParticlesThanItsInterfaceHasIsRefused) {
  const Recorded recorded;
  const HdfHandle file(H5Fopen((recorded.folder.path / "exchange.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT),
                       H5Fclose, "open it");
  H5Ldelete(file, "pressure", H5P_DEFAULT);
  const hsize_t shape[] = {2, 3};
  const HdfHandle space(H5Screate_simple(2, shape, nullptr), H5Sclose, "space");
  HdfHandle(H5Dcreate2(file, "pressure", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
            H5Dclose, "pressure");
  H5Fflush(file, H5F_SCOPE_LOCAL);
  EXPECT_THAT(fault_of([&] { recorded.recording(); }),
              HasSubstr("its 'pressure' has 2 rows of 3, not 3 of 2"));
}

TEST(Recording, ThatIsDamagedIsRefused) {
  const Recorded recorded;
  const auto record = recorded.folder.path / "exchange.h5";
  const auto fault = [&] { return fault_of([&] { recorded.recording(); }); };
  std::filesystem::resize_file(record, std::filesystem::file_size(record) / 2);
  EXPECT_THAT(fault(), HasSubstr("exchange.h5: error: it is no HDF5 file, or not whole"));
  std::ofstream(record) << "no record";
  EXPECT_THAT(fault(), HasSubstr("it is no HDF5 file, or not whole"));
  std::filesystem::remove(record);
  EXPECT_THAT(fault(), HasSubstr("there is no such file"));
  HdfFile other(record);
  other.close();
  std::filesystem::rename(record.string() + ".part", record);
  EXPECT_THAT(fault(), HasSubstr("it has no 'fluid_reach'"));
}

}  // namespace
}  // namespace toryu::replay
