#include "common/scene/scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/scene/resolved_case.hpp"
#include "tests/errors/case_text.hpp"

namespace toryu {
namespace {

using testing::HasSubstr;

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
  copy_named_files(file, out);
  std::ofstream(out / "used_case.toml") << file.used();

  CaseFile again(out / "used_case.toml", {});
  const Scene repeated = read_scene(again);
  EXPECT_NO_THROW(again.throw_if_faulty());
  EXPECT_EQ(again.used(), file.used());
  EXPECT_NO_THROW(copy_named_files(again, out));
  EXPECT_GT(std::filesystem::file_size(out / "reference/level.csv"), 0u);
}

TEST_F(SceneTest, KeepsAnotherFileThatIsWhereAReferenceGoes) {
  CaseFile file(case_.folder(), {});
  const Scene scene = read_scene(file);
  const auto reference = case_.folder() / "out/reference";
  std::filesystem::create_directories(reference);
  for (const char* mine : {"mine", "mine too"}) {
    std::ofstream(reference / "level.csv") << mine;
    copy_named_files(file, case_.folder() / "out");
    copy_named_files(file, case_.folder() / "out");
  }
  EXPECT_EQ(std::filesystem::file_size(reference / "level.csv.1"), 4u);
  EXPECT_EQ(std::filesystem::file_size(reference / "level.csv.2"), 8u);
  EXPECT_FALSE(std::filesystem::exists(reference / "level.csv.3"));
  EXPECT_TRUE(std::filesystem::exists(case_.folder() / "reference/level.csv"));
}

std::string resolved(const std::filesystem::path& path) {
  CaseFile file(path, {"fluid.more=inf"});
  std::string found = resolved_case(file);
  std::erase_if(found, [](char c) { return c == ' ' || c == '\n'; });
  return found;
}

TEST_F(SceneTest, IsResolvedForOtherPrograms) {
  const std::string found = resolved(case_.folder());
  EXPECT_THAT(found, HasSubstr(R"("kind":"fluid")"));
  EXPECT_THAT(found, HasSubstr(R"("name":")" + case_.folder().filename().string() + '"'));
  EXPECT_THAT(found, HasSubstr(R"("inputs":[")" + (case_.folder() / "case.toml").string() + "\"]"));
  EXPECT_THAT(found, HasSubstr(R"("fluid":{"more":Infinity})"));
  EXPECT_THAT(found, HasSubstr(R"([["wall",1,"name"],12,1])"));
  EXPECT_THAT(found, HasSubstr(R"("label":"measured","points":[[0.0,1.0]],)"));
}

TEST_F(SceneTest, IsResolvedWithTheFaultOfAReference) {
  case_.add("reference/level.csv", "time,level\n0,high\n");
  const std::string found = resolved(case_.folder());
  EXPECT_THAT(found, HasSubstr(R"("fault":"reference/level.csv:2:'high'isnonumber,inthecolumn'level'")"));
}

TEST(Study, IsToldByItsTable) {
  for (const char* head : {"[study]\n", "[ study ]\n", "study.title = 'a'\n", "study = 1\n",
                           "\"study\" = {}\n", "\xEF\xBB\xBF[[study]]\n"}) {
    const CaseText one(std::string(head) + "[fluid]\n");
    EXPECT_EQ(CaseFile(one.folder(), {}).kind(), Kind::study) << head;
  }
  EXPECT_EQ(CaseFile(CaseText("[fluid]\nstudy = 1\n").folder(), {}).kind(), Kind::fluid);
  EXPECT_EQ(CaseFile(CaseText("# [study]\n[fluid]\n[solid]\n").folder(), {}).kind(), Kind::coupled);
  EXPECT_EQ(CaseFile(CaseText("fluid = false\n[solid]\n").folder(), {}).kind(), Kind::solid);
  EXPECT_EQ(CaseFile(CaseText("text = '''\n[study]\n'''\n").folder(), {}).kind(), Kind::empty);
}

TEST(Box, HoldsItsSmallerCornerOnly) {
  const Box box{Vec(0, 0), Vec(1, 2)};
  EXPECT_TRUE(box.contains(Vec(0, 0)));
  EXPECT_TRUE(box.contains(Vec(0.5, 1.9)));
  EXPECT_FALSE(box.contains(Vec(1, 1)));
  EXPECT_FALSE(box.contains(Vec(0.5, 2)));
  EXPECT_FALSE(box.contains(Vec(-0.1, 1)));
}

TEST(SceneMotion, IsSharedAndItsRowsMayBeThoseOfAFile) {
  const CaseText the_case(
      "[case]\ntitle='A'\nend_time=1\ndomain={min=[-3,-3], max=[3,3]}\n"
      "gravity_change={acceleration='quake.csv'}\n"
      "[[motion]]\nname='roll'\nrotation={about=[1,1], angle='roll.csv', jumps=true}\n"
      "[[wall]]\nname='floor'\nbox={min=[0,0], max=[2,1]}\nmoves_with='roll'\n");
  the_case.add("roll.csv", "angle[rad], level[m], time [s]\n0, 7, 0\n0.5, 8, 2\n");
  the_case.add("quake.csv", "time[s],a_x[m/s2],a_y[m/s2]\n0,0,0\n1,2,4\n");
  CaseFile file(the_case.folder(), {});
  const Scene scene = read_scene(file);
  file.throw_if_faulty();
  EXPECT_EQ(scene.walls[0].motion->pose_at(1).angle, 0.25);
  EXPECT_EQ(scene.walls[0].motion->rotation->about, Vec(1, 1));
  EXPECT_EQ(scene.gravity_at(0.5), Vec(1, 2));
  EXPECT_THAT(file.used(), HasSubstr("angle = [[0.0, 0.0], [2.0, 0.5]]"))
      << "what repeats the run has the rows";
}

}  // namespace
}  // namespace toryu
