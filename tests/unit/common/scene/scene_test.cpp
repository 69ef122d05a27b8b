#include "common/scene/scene.hpp"

#include <gtest/gtest.h>

#include "tests/errors/case_text.hpp"

namespace toryu {
namespace {

const std::string text = R"(
[case]
title = "A tank with a lid"
gravity = [0.0, -9.81]
end_time = 0.4
frame_interval = 0.005
domain = { min = [-1, -1], max = [2, 3] }
[[wall]]
name = "floor"
box = { min = [-1, -1], max = [2, 0] }
[[wall]]
name = "lid"
box = { min = [0, 2], max = [1, 3] }
motion = { velocity = [[0.0, 0.0, 0.0], [1.0, 0.0, -0.1]], speed = 3.0, time = 2.0 }
work_piece = true
[[reference]]
label = "measured"
file = "reference/level.csv"
series = "fluid.csv:level[m]"
column = "level"
)";

class SceneTest : public testing::Test {
 protected:
  SceneTest() : case_(text) {
    std::filesystem::create_directory(case_.folder() / "reference");
    std::ofstream(case_.folder() / "reference/level.csv") << "time,level\n0,1\n";
  }
  CaseText case_;
};

TEST_F(SceneTest, IsReadWithWallsAndReferences) {
  CaseFile file(case_.folder(), {});
  const Scene scene = read_scene(file);
  file.throw_if_faulty();
  EXPECT_EQ(scene.title, "A tank with a lid");
  EXPECT_EQ(scene.gravity, Vec(0, -9.81));
  EXPECT_EQ(scene.end_time, 0.4);
  EXPECT_EQ(scene.frame_interval, 0.005);
  EXPECT_EQ(scene.series_interval, 0);
  EXPECT_EQ(scene.domain.max, Vec(2, 3));
  ASSERT_EQ(scene.walls.size(), 2u);
  EXPECT_FALSE(scene.walls[0].motion);
  EXPECT_EQ(scene.walls[1].name, "lid");
  EXPECT_FALSE(scene.walls[0].work_piece);
  EXPECT_TRUE(scene.walls[1].work_piece);
  EXPECT_EQ(scene.walls[1].motion->velocity_at(2), Vec(0, 3.0 * -0.1));
  EXPECT_EQ(scene.walls[1].motion->velocity_at(1), Vec(0, 3.0 * -0.05));
  ASSERT_EQ(scene.references.size(), 1u);
  EXPECT_EQ(scene.references[0].column, "level");
}

TEST_F(SceneTest, RepeatsFromTheResultsFolder) {
  CaseFile file(case_.folder(), {});
  const Scene scene = read_scene(file);
  const auto out = case_.folder() / "out";
  copy_references(scene, file, out);
  std::ofstream(out / "used_case.toml") << file.used();

  CaseFile again(out / "used_case.toml", {});
  const Scene repeated = read_scene(again);
  EXPECT_NO_THROW(again.throw_if_faulty());
  EXPECT_EQ(again.used(), file.used());
  EXPECT_NO_THROW(copy_references(repeated, again, out));
  EXPECT_GT(std::filesystem::file_size(out / "reference/level.csv"), 0u);
}

TEST(Box, HoldsItsSmallerCornerOnly) {
  const Box box{Vec(0, 0), Vec(1, 2)};
  EXPECT_TRUE(box.contains(Vec(0, 0)));
  EXPECT_TRUE(box.contains(Vec(0.5, 1.9)));
  EXPECT_FALSE(box.contains(Vec(1, 1)));
  EXPECT_FALSE(box.contains(Vec(0.5, 2)));
  EXPECT_FALSE(box.contains(Vec(-0.1, 1)));
}

}  // namespace
}  // namespace toryu
