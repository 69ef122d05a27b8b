// The exact text of each fault of what all programs read of a scene: [case] and walls.
#include <gtest/gtest.h>

#include "tests/errors/case_text.hpp"

namespace toryu {
namespace {

TEST(SceneFaults, None) {
  EXPECT_EQ(CaseText(sound_scene).scene_faults(), "");
}

TEST(SceneFaults, OfTheWholeCase) {
  EXPECT_EQ(CaseText("[case]\nend_time = 0\nframe_interval = -1\n[case.domain]\nmin=[0,0]\nmax=[0,1]\n")
                .scene_faults(),
            "case.toml:1:2: error: missing key 'title' in [case]: text, heads the log and the report\n"
            "case.toml:2:1: error: 'end_time' in [case] must be above 0 [s], found 0\n"
            "case.toml:3:1: error: 'frame_interval' in [case] must be at least 0 [s], found -1\n"
            "case.toml:6:1: error: 'max' must exceed 'min' in each direction");
}

TEST(SceneFaults, WallsOfOneName) {
  EXPECT_EQ(CaseText(sound_scene + "[[wall]]\nname = 'floor'\nbox = {min=[0,1], max=[2,2]}\n").scene_faults(),
            "case.toml:9:1: error: two [[wall]] are named 'floor'; names must differ");
}

TEST(SceneFaults, WallBeyondTheDomain) {
  EXPECT_EQ(CaseText(sound_scene + "[[wall]]\nname = 'roof'\nbox = {min=[0,1], max=[2,3]}\n").scene_faults(),
            "case.toml:10:1: error: the box of wall 'roof' is not within [case.domain]");
}

TEST(SceneFaults, RegionsOutsideTheDomain) {
  const std::string region = "region = [{name='r', box={min=[2,1], max=[3,2]}}]\n";
  EXPECT_EQ(CaseText(sound_scene + "[fluid]\n" + region).scene_faults(),
            "case.toml:9:22: error: the fluid's region 'r' lies outside [case.domain]");
  EXPECT_EQ(CaseText(sound_scene + "[solid]\n" + region).scene_faults(),
            "case.toml:9:22: error: the solid's region 'r' lies outside [case.domain]");
  EXPECT_EQ(CaseText(sound_scene + "[fluid]\n" + region).scene_faults({"case.periodic=\"x\""}), "");
}

TEST(SceneFaults, OfWhatSeveralChangedAreToldAtTheOverride) {
  const CaseText text("base = 'other.toml'\n[[fluid.region]]\nname = 'r'\nbox = {max=[3.5,2]}\n");
  text.add("other.toml", sound_scene + "[fluid]\nregion = [{name='r', box={min=[0,1], max=[1,2]}}]\n");
  EXPECT_EQ(text.scene_faults({"fluid.region.r.box.min=[2.5,1]"}),
            "--set fluid.region.r.box.min=[2.5,1]: error: the fluid's region 'r' lies outside [case.domain]");
}

TEST(SceneFaults, MotionWhoseTimesDoNotIncrease) {
  EXPECT_EQ(
      CaseText(sound_scene + "motion = { velocity = [[0, 0, 0], [1, 1, 0], [1, 2, 0]] }\n").scene_faults(),
      "case.toml:8:12: error: times in 'velocity' must increase: 1 comes after 1");
}

TEST(SceneFaults, EachJointCheckOfASection) {
  EXPECT_EQ(
      CaseText(sound_scene + "motion = { velocity = [[2, 0, 0], [1, 1, 0], [0, 2, 0]] }\n").scene_faults(),
      "case.toml:8:12: error: times in 'velocity' must increase: 1 comes after 2\n"
      "case.toml:8:12: error: times in 'velocity' must increase: 0 comes after 1");
}

TEST(SceneFaults, WallWithAFaultyBoxIsNotComparedWithTheDomain) {
  EXPECT_EQ(CaseText(sound_scene + "[[wall]]\nname = 'roof'\nbox = {min=[0,5], max=[2,4]}\n").scene_faults(),
            "case.toml:10:19: error: 'max' must exceed 'min' in each direction");
}

/// The faults of a floor that is worn so.
std::string faults_of_worn(const std::string& worn) {
  return CaseText(sound_scene + "worn = [" + worn + "]\n").scene_faults();
}

TEST(SceneFaults, OfAWornFace) {
  EXPECT_EQ(faults_of_worn("{ face = 'upper', depth = [[0, 0.1], [2, 0.2]] }"), "");
  EXPECT_EQ(faults_of_worn("{ face = 'top', depth = [[0, 0.1]] }"),
            "case.toml:8:11: error: 'face' in [[wall.worn]] must be one of 'left', 'right', 'lower', "
            "'upper', found 'top'");
  EXPECT_EQ(faults_of_worn("{ face = 'upper', depth = [[1, 0.1], [1, 0.2]] }"),
            "case.toml:8:27: error: positions in 'depth' must increase: 1 comes after 1");
  EXPECT_EQ(faults_of_worn("{ face = 'upper', depth = [[1, -0.1]] }"),
            "case.toml:8:27: error: a depth must be at least 0 [m], found -0.1 at 1");
  EXPECT_EQ(faults_of_worn("{ face = 'upper', depth = [] }"),
            "case.toml:8:27: error: 'depth' needs at least one row");
  EXPECT_EQ(faults_of_worn("{ face = 'upper', depth = [[20, 0.1]] }"),
            "case.toml:8:1: error: positions along the upper face lie between 0 and 2 [m], found 20");
  EXPECT_EQ(faults_of_worn("{ face = 'upper', depth = [[0, 0.6]] }, { face = 'lower', depth = [[0, 0.4]] }"),
            "case.toml:8:1: error: the depths along y add up to 1 [m]: the wall is only 1 [m] thick");
  EXPECT_EQ(faults_of_worn("{ face = 'upper', depth = [[0, 0.1]] }, { face = 'upper', depth = [[0, 0.2]] }"),
            "case.toml:8:1: error: the upper face is 'worn' twice");
}

TEST(SceneFaults, OfAWornSolidInAFluid) {
  const std::string solid =
      "[solid]\n[[solid.region]]\nname = 'plate'\nbox = {min=[0,1], max=[1,2]}\n"
      "worn = [{ face = 'upper', depth = [[0, 0.1]] }]\n";
  EXPECT_EQ(CaseText(sound_scene + solid).scene_faults(), "");
  EXPECT_EQ(CaseText(sound_scene + solid + "[fluid]\n").scene_faults(),
            "case.toml:12:1: error: a solid in a fluid cannot have worn regions: the fluid fills up to the "
            "faces of their boxes");
}

const std::string round_scene =
    "[case]\ntitle = 'A'\nend_time = 1\ngeometry = 'axisymmetric'\ndomain = {min=[0,-2], max=[2,2]}\n";

TEST(SceneFaults, AboutAnAxis) {
  EXPECT_EQ(CaseText(round_scene + "[[wall]]\nname = 'pin'\nbox = {min=[0,0], max=[1,1]}\n").scene_faults(),
            "");
  EXPECT_EQ(CaseText(round_scene + "periodic = 'x'\n").scene_faults(), "");
  EXPECT_EQ(CaseText(round_scene + "[[wall]]\nname = 'pin'\nbox = {min=[0,-1], max=[1,1]}\n").scene_faults(),
            "case.toml:8:1: error: the wall 'pin' crosses the axis: y is the distance from it, at least 0");
  EXPECT_EQ(CaseText(round_scene + "[[wall]]\nname = 'pin'\nbox = {min=[0,0], max=[1,1]}\n"
                                   "motion = {velocity = [[0, 0, 0.5]]}\n")
                .scene_faults(),
            "case.toml:9:1: error: the wall 'pin' moves across the axis: it can move along x alone");
  EXPECT_EQ(
      CaseText(round_scene + "periodic = 'xy'\ngravity = [0, 1]\n[solid]\n").scene_faults(),
      "case.toml:4:1: error: a scene with a solid cannot be axisymmetric: solids know no axis\n"
      "case.toml:6:1: error: about an axis space repeats itself along it alone: \"x\", or leave 'periodic' "
      "out\n"
      "case.toml:7:1: error: gravity across the axis is not axisymmetric: give it along x alone");
}

TEST(SceneFaults, WhereSpaceRepeatsItself) {
  const std::string scene =
      "[case]\ntitle = 'A'\nend_time = 1\nperiodic = 'x'\ndomain = {min=[0,0], max=[2,2]}\n"
      "[fluid]\nspacing = 0.1\n[[fluid.region]]\nname = 'medium'\nbox = {min=[0,0], max=[2,2]}\n"
      "[[fluid.hole]]\nmin = [-0.5, 0]\nmax = [0.5, 1]\n";
  const auto with = [&](const std::string& body, const std::string& box) {
    return CaseText(scene + body + "\nname = 'block'\nbox = " + box + "\n").scene_faults();
  };
  for (const std::string body : {"[[wall]]", "[[solid.region]]"}) {
    EXPECT_EQ(with(body, "{min=[-0.5,0], max=[0.5,1]}"), "") << "it may cross a side";
    EXPECT_EQ(with(body, "{min=[1.5,0], max=[2.5,1]}"), "") << "the hole has images";
    EXPECT_NE(with(body, "{min=[1.4,0], max=[2.5,1]}").find("overlaps"), std::string::npos);
  }
  EXPECT_EQ(with("[[wall]]", "{min=[-1.5,-1], max=[-0.5,0]}"),
            "case.toml:16:1: error: the box of wall 'block' is not within [case.domain]");
  EXPECT_EQ(with("[[wall]]", "{min=[-0.5,0], max=[0.5,1]}\nworn = [{ face = 'upper', depth = [[0, 0.1]] }]"),
            "case.toml:17:1: error: a wall with worn faces cannot cross a side of [case.domain]");
  EXPECT_EQ(with("[[solid.region]]", "{min=[-0.5,-1], max=[1.6,0]}"),
            "case.toml:16:1: error: the solid's region 'block' is 2.1 m long along x, in which space repeats "
            "itself after 2 m: it overlaps itself\n"
            "case.toml:16:1: error: the solid's region 'block' lies outside [case.domain]");
}

TEST(SceneFaults, MotionWithoutRows) {
  EXPECT_EQ(CaseText(sound_scene + "motion = { velocity = [] }\n").scene_faults(),
            "case.toml:8:12: error: a motion needs rows of its 'velocity' or 'position', a 'sine' or a "
            "'rotation'");
  EXPECT_EQ(CaseText(sound_scene + "motion.rotation = { about = [0, 0] }\n").scene_faults(),
            "case.toml:8:8: error: what turns needs rows of its 'angle' or 'angular_velocity', or a 'sine'");
}

TEST(SceneFaults, MotionThatJumps) {
  const std::string sine = "sine = [{ amplitude = 1, frequency = 2, direction = [1, 0]";
  EXPECT_EQ(
      CaseText(sound_scene + "motion = { " + sine + "}] }\n").scene_faults(),
      "case.toml:8:12: error: a sine without a 'ramp' starts with its full speed at once: give it a 'ramp' "
      "[s], or say 'jumps = true' if what it moves is to start so");
  EXPECT_EQ(CaseText(sound_scene + "motion = { " + sine + ", ramp = 1}] }\n").scene_faults(), "");
  EXPECT_EQ(CaseText(sound_scene + "motion = { " + sine + "}], jumps = true }\n").scene_faults(), "");
}

const std::string shared = "[[motion]]\nname = 'roll'\nrotation = {about = [0, 0], angle = 'roll.csv'}\n";

TEST(SceneFaults, MotionThatIsShared) {
  CaseText sound(sound_scene + "moves_with = 'roll'\n" + shared);
  sound.add("roll.csv", "# measured\ntime [s],level[m],angle[rad]\n0,7,0\n1,8,0.1\n");
  EXPECT_EQ(sound.scene_faults(), "");
  CaseText other(sound_scene + "moves_with = 'rol'\n" + shared);
  other.add("roll.csv", "time[s],angle[rad]\n0,0\n1,0.1\n");
  EXPECT_EQ(other.scene_faults(), "case.toml:8:1: error: no [[motion]] is named 'rol'; did you mean 'roll'?");
  CaseText both(sound_scene + "moves_with = 'roll'\nmotion = { velocity = [[0, 0, 1]] }\n" + shared);
  both.add("roll.csv", "time[s],angle[rad]\n0,0\n1,0.1\n");
  EXPECT_EQ(both.scene_faults(),
            "case.toml:8:1: error: a wall has either a 'motion' of its own or one of those that are shared");
}

TEST(SceneFaults, MotionThatNothingShares) {
  CaseText text(sound_scene + shared);
  text.add("roll.csv", "time[s],angle[rad]\n0,0\n1,0.1\n");
  EXPECT_EQ(
      text.scene_faults(),
      "case.toml:9:1: error: nothing moves with 'roll': give moves_with = \"roll\" to a wall or a clamp");
}

TEST(SceneFaults, TurnsThatDoNotGoWithTheRest) {
  const std::string turning = "motion.rotation = { about = [1, 1], angular_velocity = [[0, 1]] }\n";
  EXPECT_EQ(
      CaseText(sound_scene + turning + "[fluid]\nwall_slip = {}\n").scene_faults(),
      "case.toml:8:1: error: a wall that turns does not go with [fluid.wall_slip], which knows plane walls "
      "alone");
  EXPECT_EQ(
      CaseText(sound_scene + "motion.rotation = { about = [1e300, 1], angular_velocity = [[0, 1e300]] }\n")
          .scene_faults(),
      "case.toml:8:1: error: its speed is beyond all numbers");
}

TEST(SceneFaults, RowsOfAFile) {
  const auto faults = [](const std::string& file) {
    CaseText text(sound_scene + "moves_with = 'roll'\n" + shared);
    text.add("roll.csv", file);
    return text.scene_faults();
  };
  EXPECT_EQ(CaseText(sound_scene + "moves_with = 'roll'\n" + shared).scene_faults(),
            "case.toml:11:29: error: no file 'roll.csv' in the folder of the case");
  EXPECT_EQ(faults("time[s],angle[deg]\n0,0\n"),
            "roll.csv:1:1: error: no column 'angle[rad]'; the columns are 'time[s]', 'angle[deg]'");
  EXPECT_EQ(faults("time[s],angle[rad]\n0,0\n1,x\n"),
            "roll.csv:3:1: error: 'x' is no number, in the column 'angle[rad]'");
  EXPECT_EQ(faults("time[s],angle[rad]\n0,0\n1\n"), "roll.csv:3:1: error: 1 cell in a row under 2 columns");
  EXPECT_EQ(faults("time[s],angle[rad]\n1,0\n1,1\n"),
            "case.toml:11:29: error: times in 'angle' must increase: 1 comes after 1");
}

TEST(SceneFaults, NoneOfATableInAFileThatEntersTheHash) {
  CaseText text(sound_scene + "moves_with = 'roll'\n" + shared);
  const auto hash = [&](const std::string& rows) {
    text.add("roll.csv", "time[s],angle[rad]\n" + rows);
    return CaseFile(text.folder(), {}).hash();
  };
  EXPECT_NE(hash("0,0\n1,1\n"), hash("0,0\n1,2\n"));
  EXPECT_EQ(CaseFile(text.folder(), {}).named_files(), std::vector<std::string>{"roll.csv"});
}

TEST(SceneFaults, SharedMotionAcrossTheAxis) {
  EXPECT_EQ(
      CaseText(
          round_scene +
          "[[wall]]\nname = 'pin'\nbox = {min=[0,0], max=[1,1]}\nmoves_with = 'up'\n[[motion]]\nname = 'up'\n"
          "velocity = [[0, 0, 1]]\n")
          .scene_faults(),
      "case.toml:9:1: error: the wall 'pin' moves across the axis: it can move along x alone");
}

const std::string travel = "direction = '+y', travel = [0, 0.5]";

TEST(SceneFaults, PressWithoutPressureOrWithTwo) {
  EXPECT_EQ(CaseText(sound_scene + "press = { " + travel + " }\n").scene_faults(),
            "case.toml:8:1: error: a press needs rows of either its 'pressure' or its 'force'");
  EXPECT_EQ(CaseText(sound_scene + "press = { pressure = [[0, 1]], force = [[0, 1]], " + travel + " }\n")
                .scene_faults(),
            "case.toml:8:11: error: a press needs rows of either its 'pressure' or its 'force'");
}

TEST(SceneFaults, PressWhoseTimesDoNotIncrease) {
  EXPECT_EQ(CaseText(sound_scene + "press = { force = [[1, 1], [1, 2]], " + travel + " }\n").scene_faults(),
            "case.toml:8:11: error: times in 'force' must increase: 1 comes after 1");
}

TEST(SceneFaults, PressWithoutTravel) {
  EXPECT_EQ(CaseText(sound_scene + "press = { force = [[0, 1]], direction = '+y', travel = [0.1, 0.5] }\n")
                .scene_faults(),
            "case.toml:8:47: error: 'travel' begins at most at 0 and ends at least there: [-0.01, 0.02]");
}

TEST(SceneFaults, PressThatCannotMove) {
  EXPECT_EQ(
      CaseText(sound_scene + "press = { force = [[0, 1]], direction = '+y', travel = [0, 0] }\n")
          .scene_faults(),
      "case.toml:8:47: error: by its 'travel' the wall cannot move: give it a way, [-0.01, 0.02], or no "
      "'press'");
}

TEST(SceneFaults, PressBesideAMotion) {
  EXPECT_EQ(
      CaseText(sound_scene + "motion = { velocity = [[0, 0, 0]] }\npress = { force = [[0, 1]], direction = "
                             "'+y', travel = [0, 0.5] }\n")
          .scene_faults(),
      "case.toml:9:1: error: a wall has either a 'motion' or a 'press'");
}

TEST(SceneFaults, PressThatLeavesTheDomain) {
  EXPECT_EQ(CaseText(sound_scene + "press = { force = [[0, 1]], direction = '-y', travel = [0, 0.5] }\n")
                .scene_faults(),
            "case.toml:8:47: error: the wall 'floor' leaves [case.domain] by its travel");
}

TEST(SceneFaults, PressOfASolidOrInPeriodicSpace) {
  const std::string press = "press = { force = [[0, 1]], direction = '+y', travel = [0, 0.5] }\n";
  EXPECT_EQ(CaseText(sound_scene + press + "[solid]\nspacing = 0.1\n").scene_faults(),
            "case.toml:8:1: error: a solid knows of no walls that the fluid moves: prescribe a 'motion'");
  EXPECT_EQ(CaseText("[case]\nperiodic = 'x'\n" + sound_scene.substr(7) + press).scene_faults(),
            "case.toml:9:1: error: a wall that is pressed does not go with space that repeats itself");
}

}  // namespace
}  // namespace toryu
