// Bodies of a case that are in one place: at the start, as all programs see them, and as walls move.
#include "common/scene/bodies.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/errors/case_text.hpp"

namespace toryu {
namespace {

/// Water from x = 0 to 1 beside a gate from 1 to 1.2, whose upper half is held.
const std::string gate =
    "[case]\ntitle='A'\nend_time=2\ndomain={min=[-4,-4], max=[4,4]}\n"
    "[fluid]\nspacing=0.1\n[[fluid.region]]\nname='water'\nbox={min=[0,0], max=[1,1]}\n"
    "[solid]\nspacing=0.05\n[[solid.region]]\nname='gate'\nbox={min=[1,0], max=[1.2,2]}\n"
    "[[solid.clamp]]\nname='root'\nbox={min=[1,1], max=[1.2,2]}\n";

const std::string water =
    "[case]\ntitle='A'\nend_time=2\ndomain={min=[-4,-4], max=[4,4]}\n"
    "[fluid]\nspacing=0.1\n[[fluid.region]]\nname='water'\nbox={min=[0,0], max=[1,1]}\n";

std::string wall(const std::string& name, const std::string& box, const std::string& motion = "") {
  return "[[wall]]\nname='" + name + "'\nbox={" + box + "}\n" +
         (motion.empty() ? "" : "motion={velocity=[" + motion + "]}\n");
}

std::string turning(const std::string& name, const std::string& box, const std::string& rotation) {
  return "[[wall]]\nname='" + name + "'\nbox={" + box + "}\nmotion.rotation={" + rotation + "}\n";
}

std::string pressed(const std::string& name, const std::string& box, const std::string& travel) {
  return "[[wall]]\nname='" + name + "'\nbox={" + box + "}\npress={force=[[0,1]], direction='+x', travel=[" +
         travel + "]}\n";
}

TEST(Bodies, ClampsGoWithOutlinesThatTheyStandOn) {
  const auto moving_clamps = [](const std::string& polygon) {
    const CaseText text(gate + "[[wall]]\nname='lid'\npolygon=" + polygon +
                        "\nmotion={velocity=[[0,0,0],[1,1,0]]}\n");
    CaseFile file(text.folder(), {});
    return clamp_motions(file, read_scene(file)).at(0).has_value();
  };
  EXPECT_TRUE(moving_clamps("[[0,2], [3,2], [3,3], [1,3.5], [0,3]]"));
  EXPECT_FALSE(moving_clamps("[[1.1,2], [3,2], [3,3], [1,3.5], [1.1,3]]"))
      << "it holds half of the clamp alone";
  EXPECT_FALSE(moving_clamps("[[0,2.1], [3,2.1], [3,3], [1,3.5], [0,3]]")) << "it stands off";
}

TEST(Bodies, ThatStandSideBySideHaveNoGapBetween) {
  const auto gaps = [](const std::string& bodies) {
    const CaseText text(water + bodies);
    CaseFile file(text.folder(), {});
    return gap_warnings(file, read_scene(file));
  };
  const auto part = [](const std::string& list, const std::string& name, const std::string& box) {
    return "[[" + list + "]]\nname='" + name + "'\nbox={" + box + "}\n";
  };
  const std::string back = "min=[1.05,0], max=[1.2,1]", front = "min=[1,0], max=[1.05,1]",
                    lower_front = "min=[1,0], max=[1.05,0.6]", upper_front = "min=[1,0.6], max=[1.05,1]";
  ASSERT_EQ(gaps(part("wall", "back", back)).size(), 1u);
  EXPECT_TRUE(gaps(part("wall", "back", back))
                  .front()
                  .starts_with("the fluid's region 'water' ends at x = 1 m, 0.5 spacings off the wall "
                               "'back': it does not rest on it"));
  EXPECT_EQ(gaps(part("wall", "back", back) + part("wall", "front", front)), std::vector<std::string>{});
  EXPECT_EQ(gaps(part("wall", "back", back) + part("wall", "lower", lower_front)).size(), 1u) << "above it";
  EXPECT_EQ(gaps(part("wall", "back", back) + part("wall", "lower", lower_front) +
                 part("wall", "upper", upper_front)),
            std::vector<std::string>{});
  EXPECT_EQ(gaps(part("wall", "back", back) + part("fluid.region", "more", front)),
            std::vector<std::string>{});
  EXPECT_EQ(gaps("[solid]\nspacing=0.025\n" + part("solid.region", "back", back) +
                 part("solid.region", "front", front)),
            std::vector<std::string>{});
}

TEST(Bodies, SayWhichTurnsAreNotLookedAt) {
  const auto unknown = [](const std::string& place) {
    const CaseText text(water + "[[wall]]\nname='star'\npolygon=[[-2,-2], [-1,-1.6], [0,-2], [-1,0]]\n" +
                        "motion.rotation={about=[-1,-1], angular_velocity=[[0,1]]}\n" + wall("post", place));
    CaseFile file(text.folder(), {});
    return unknown_meetings(file, read_scene(file));
  };
  ASSERT_EQ(unknown("min=[0.2,-1.5], max=[0.5,-1]").size(), 1u);
  EXPECT_EQ(
      unknown("min=[0.2,-1.5], max=[0.5,-1]")[0],
      "the wall 'post' and the wall 'star': whether they meet is not looked at, since one of them turns and "
      "has holes or is not convex");
  EXPECT_TRUE(unknown("min=[3,3], max=[3.5,3.5]").empty()) << "out of its reach";
}

struct Scenery {
  const char* name;
  std::string text;
  const char* expected;
};

class BodyFaults : public testing::TestWithParam<Scenery> {};

TEST_P(BodyFaults, NameBothAndThePlace) {
  EXPECT_EQ(CaseText(GetParam().text).scene_faults(), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    AtTheStart, BodyFaults,
    testing::Values(
        Scenery{"NoneThatTouch", gate + wall("floor", "min=[-1,-1], max=[2,0]"), ""},
        Scenery{"NoneWithinATenthOfASpacing", gate + wall("floor", "min=[-1,-1], max=[2,0.004]"), ""},
        Scenery{"NoneOfAClampInAWall", gate + wall("lid", "min=[0.9,1], max=[1.3,2.1]"), ""},
        Scenery{"NoneInAHole",
                gate + "[[fluid.hole]]\nmin=[0.3,0.3]\nmax=[0.6,0.6]\n" +
                    wall("post", "min=[0.3,0.3], max=[0.6,0.6]"),
                ""},
        Scenery{"NoneOfDiscsAtACorner",
                gate + wall("a", "min=[-3,-3], max=[-1,-1], round=true") +
                    wall("b", "min=[-1.25,-1.25], max=[-1,-1]"),
                ""},
        Scenery{
            "WaterInAWall", gate + wall("post", "min=[0.4,0.4], max=[0.6,3]"),
            "case.toml:9:1: error: the fluid's region 'water' overlaps the wall 'post' near (0.5, 0.7) m"},
        Scenery{"WaterInTheSolid", gate + "[[fluid.region]]\nname='more'\nbox={min=[1,0], max=[1.1,0.5]}\n",
                "case.toml:20:1: error: the fluid's region 'more' overlaps the solid's region 'gate' near "
                "(1.05, 0.25) m"},
        Scenery{"WaterAroundAHoleThatIsTooSmall",
                gate + "[[fluid.hole]]\nmin=[0.3,0.3]\nmax=[0.5,0.6]\n" +
                    wall("post", "min=[0.3,0.3], max=[0.6,0.6]"),
                "case.toml:9:1: error: the fluid's region 'water' overlaps the wall 'post' near (0.55, "
                "0.45) m"},
        Scenery{"AFreeGateInAWall", gate + wall("post", "min=[1,0.5], max=[1.1,1.5]"),
                "case.toml:20:1: error: the wall 'post' overlaps the solid's region 'gate' near (1.05, "
                "0.75) m; what a wall holds of a solid is a [[solid.clamp]]"},
        Scenery{"ARigidFloatInAWall",
                water + "[solid]\nformulation='rigid'\n[[solid.region]]\nname='float'\n" +
                    "box={min=[1,0], max=[1.1,1]}\n" + wall("post", "min=[1,0.5], max=[1.1,1.5]"),
                "case.toml:17:1: error: the wall 'post' overlaps the solid's region 'float' near (1.05, "
                "0.75) m"},
        Scenery{"TwoWalls",
                gate + wall("a", "min=[-2,-2], max=[-1,-1]") + wall("b", "min=[-2,-1.5], max=[-1,0]"),
                "case.toml:23:1: error: the wall 'b' overlaps the wall 'a' near (-1.5, -1.25) m"},
        Scenery{"DiscsThatMeet",
                gate + wall("a", "min=[-3,-3], max=[-1,-1], round=true") +
                    wall("b", "min=[-1.5,-2.1], max=[-1,-1.9]"),
                "case.toml:23:1: error: the wall 'b' overlaps the wall 'a' near (-1.48977, -2.09445) m"},
        Scenery{"NoneOfAWallThatTakesTheClampInItAlong",
                gate + wall("lid", "min=[0.9,1], max=[1.3,2.1]", "[0,0,0],[1,0,1]"), ""},
        Scenery{"NoneOfAWallThatTurnsWithTheClampInIt",
                gate + turning("lid", "min=[0.9,1], max=[1.3,2.1]", "about=[1,1], angular_velocity=[[0,1]]"),
                ""},
        Scenery{"AWallThatLeavesAClampWhichAnotherHolds",
                gate + wall("lid", "min=[0.9,2], max=[1.3,2.1]", "[0,0,0],[1,1,0]") +
                    wall("post", "min=[1.2,0.9], max=[1.4,2]"),
                "case.toml:20:1: error: the wall 'lid' moves, and the solid's clamp 'root', which it holds, "
                "stands still"},
        Scenery{"AWallAtRestThatAClampLeaves",
                "[[motion]]\nname='roll'\nvelocity=[[0,0,0],[1,1,0]]\n" + gate + "moves_with='roll'\n" +
                    wall("lid", "min=[0.9,2], max=[1.3,2.1]"),
                "case.toml:24:1: error: the wall 'lid' stands still, and the solid's clamp 'root', which it "
                "holds, "
                "moves"}),
    name_of<Scenery>);

/// Two clamps on the gate, which move with the motions of these names.
std::string clamped(const std::string& box, const std::string& root, const std::string& top) {
  std::string motions;
  for (const auto& name : std::set<std::string>{root, top})
    if (!name.empty()) motions += "[[motion]]\nname='" + name + "'\nvelocity=[[0,0,0],[1,1,0]]\n";
  const auto with = [](const std::string& name) { return name.empty() ? "" : "moves_with='" + name + "'\n"; };
  return motions + gate + with(root) + "[[solid.clamp]]\nname='top'\nbox={" + box + "}\n" + with(top);
}

INSTANTIATE_TEST_SUITE_P(
    OfClamps, BodyFaults,
    testing::Values(
        Scenery{"NoneOfClampsThatOnlyTouch", clamped("min=[1,0.5], max=[1.2,1]", "", "roll"), ""},
        Scenery{"NoneOfClampsThatMoveAlike", clamped("min=[1,0.5], max=[1.2,1.5]", "roll_too", "roll"), ""},
        Scenery{"NoneOfClampsAtRest", clamped("min=[1,0.5], max=[1.2,1.5]", "", ""), ""},
        Scenery{"ClampsOfWhichOneMoves", clamped("min=[1,0.5], max=[1.2,1.5]", "", "roll"),
                "case.toml:23:1: error: the solid's clamp 'top' overlaps the solid's clamp 'root' near (1.1, "
                "1.25) m, and they do not move alike"}),
    name_of<Scenery>);

INSTANTIATE_TEST_SUITE_P(
    AlongTravels, BodyFaults,
    testing::Values(
        Scenery{"NoneWhereTheFluidIsPressed",
                water + pressed("piston", "min=[-0.5,0], max=[0,1]", "-1, 0.9") +
                    wall("stop", "min=[2,0], max=[3,1]"),
                ""},
        Scenery{"AStopWithinTheTravel",
                water + pressed("piston", "min=[-0.5,0], max=[0,1]", "0, 1.2") +
                    wall("stop", "min=[1,0], max=[3,1]"),
                "case.toml:16:1: error: the wall 'stop' overlaps the wall 'piston' near (1.1, 0.5) m, with "
                "the travel of "
                "what is pressed"},
        Scenery{"APistonInTheWater", water + pressed("piston", "min=[-0.5,0], max=[0.2,1]", "0, 0.1"),
                "case.toml:9:1: error: the fluid's region 'water' overlaps the wall 'piston' near (0.1, 0.5) "
                "m"}),
    name_of<Scenery>);

INSTANTIATE_TEST_SUITE_P(
    AlongMotions, BodyFaults,
    testing::Values(
        Scenery{"NoneOfAWallWhoseTableIsAllZero",
                gate + wall("lid", "min=[0.9,1], max=[1.3,2.1]", "[0,0,0],[1,0,0]"), ""},
        Scenery{"NoneOfAPistonThatSlidesAlongAClamp",
                gate + wall("piston", "min=[1.2,1], max=[1.6,1.5]", "[0,0,0.1]"), ""},
        Scenery{"NoneThatMoveAlike",
                gate + wall("a", "min=[-2,-2], max=[-1,-1]", "[0,1,0]") +
                    wall("b", "min=[-1,-2], max=[0,-1]", "[0,1,0]"),
                ""},
        Scenery{"NoneOfAPistonThatEntersWater", gate + wall("piston", "min=[-1,0], max=[0,1]", "[0,0.1,0]"),
                ""},
        Scenery{"NoneThatTurnsBackInTime",
                gate + wall("post", "min=[2,0], max=[3,1]") +
                    wall("piston", "min=[1.4,0], max=[1.5,1]", "[0,1,0],[1,-1,0],[2,0,0]"),
                ""},
        Scenery{"NoneAfterTheEnd",
                gate + wall("post", "min=[2,0], max=[3,1]") +
                    wall("piston", "min=[1.4,0], max=[1.5,1]", "[0,0.2,0]"),
                ""},
        Scenery{
            "APistonThatRunsIntoAWall",
            gate + wall("post", "min=[2,0], max=[3,1]") +
                wall("piston", "min=[1.4,0], max=[1.5,1]", "[0,0.5,0]"),
            "case.toml:23:1: error: the wall 'piston' runs into the wall 'post' at t = 1.01 s near (2.0025, "
            "0.5) m"},
        Scenery{"APistonThatPassesAWallBetweenTwoRows",
                gate + wall("post", "min=[2,0], max=[2.1,1]") +
                    wall("piston", "min=[1.4,0], max=[1.5,1]", "[0,0,0],[0.01,200,0],[0.02,0,0],[1,0,0]"),
                "case.toml:23:1: error: the wall 'piston' runs into the wall 'post' at t = 0.007106 s near "
                "(2.0025, 0.5) m"},
        Scenery{"APaddleThatTurnsIntoAWall",
                water + wall("roof", "min=[-3,1.9], max=[3,3]") +
                    turning("paddle", "min=[-2,0.9], max=[-1,1.1]", "about=[-2,1], angular_velocity=[[0,1]]"),
                "case.toml:15:1: error: the wall 'paddle' runs into the wall 'roof' at t = 1.035 s near "
                "(-1.57136, 1.90361) m"},
        Scenery{"NoneOfAPaddleWithRoom",
                water + wall("roof", "min=[-3,2.1], max=[3,3]") +
                    turning("paddle", "min=[-2,0.9], max=[-1,1.1]", "about=[-2,1], angular_velocity=[[0,1]]"),
                ""},
        Scenery{"APistonThatSwingsIntoAWall",
                gate + wall("post", "min=[2,0], max=[3,1]") +
                    "[[wall]]\nname='piston'\nbox={min=[1.4,0], max=[1.5,1]}\n"
                    "motion={sine=[{amplitude=0.51, direction=[1,0], frequency=1}], jumps=true}\n",
                "case.toml:23:1: error: the wall 'piston' runs into the wall 'post' at t = 0.2286 s near "
                "(2.0025, "
                "0.5) m"},
        Scenery{"APistonThatRunsIntoAClamp", gate + wall("piston", "min=[2,1.2], max=[2.5,1.5]", "[0,-1,0]"),
                "case.toml:20:1: error: the wall 'piston' runs into the solid's clamp 'root' at t = 0.805 s "
                "near (1.1975, 1.35) m"},
        Scenery{"OfAPeriod",
                "[case]\ntitle='A'\nend_time=3\nperiodic='x'\ndomain={min=[0,0], "
                "max=[4,4]}\n[fluid]\nspacing=0.1\n" +
                    wall("post", "min=[0,0], max=[1,1]") + wall("plate", "min=[2,0], max=[3,1]", "[0,1,0]"),
                "case.toml:13:1: error: the wall 'plate' runs into the wall 'post' at t = 1.01 s near "
                "(0.005, 0.5) m"},
        Scenery{"OfAPeriodWithinReachBeforeTheNextOne",
                "[case]\ntitle='A'\nend_time=3\nperiodic='x'\ndomain={min=[0,0], "
                "max=[4,4]}\n[fluid]\nspacing=0.1\n" +
                    wall("post", "min=[3,0], max=[3.5,1]") +
                    wall("plate", "min=[1,0], max=[1.5,1]", "[0,2,0]"),
                "case.toml:13:1: error: the wall 'plate' runs into the wall 'post' at t = 0.755 s near "
                "(3.005, 0.5) m"}),
    name_of<Scenery>);

}  // namespace
}  // namespace toryu
