#include "common/state/field.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "common/state/serialize.hpp"

namespace toryu {
namespace {

using testing::ElementsAre;

struct Sample {
  double time = 0;
  Declared<VecField> x{"position", "m", FieldKind::state};
  Declared<Field> p{"pressure", "Pa", FieldKind::derived};
  Declared<Symmetric<Field>> s{"stress", "Pa", FieldKind::state};
  Declared<Tensor<Field>> F{"gradient", "1", FieldKind::state, Presence::on_demand};
  std::vector<int> list;  ///< found anew
};
template <class Archive>
void serialize(Archive& archive, Sample& sample) {
  auto& [time, x, p, s, F, list] = sample;
  archive(time, x, p, s, F);
}

constexpr std::size_t count = 3, size = lane_count > 3 ? lane_count : 4;

/// Three particles and padding; component n of particle k holds 10 n + k.
Sample sample(bool with_gradient) {
  Sample sample;
  sample.time = 0.5;
  resize_fields(sample, size);
  if (with_gradient) resize(sample.F, size);
  double n = 0;
  for_each_field(sample, [&](auto& field) {
    for_each_component(field, [&](Field& component) {
      for (std::size_t k = 0; k < component.size(); ++k) component[k] = 10 * n + static_cast<double>(k);
      n += 1;
    });
  });
  return sample;
}

/// The particles of a field, without padding.
std::vector<double> of(const Field& component) {
  return {component.begin(), component.begin() + count};
}

TEST(Fields, AreWalkedOverInTheOrderOfTheListAndNothingElseIs) {
  Sample sample;
  std::vector<std::string> names;
  for_each_field(sample, [&](const auto& field) { names.push_back(field.name); });
  EXPECT_THAT(names, ElementsAre("position", "pressure", "stress", "gradient"));
}

TEST(Fields, AreThereAlwaysOrOnDemand) {
  Sample sample;
  resize_fields(sample, size);
  EXPECT_EQ(sample.x[1].size(), size);
  EXPECT_EQ(sample.p.size(), size);
  EXPECT_EQ(sample.s.xy.size(), size);
  EXPECT_EQ(sample.s.xy[count], 0.0);
  EXPECT_TRUE(sample.F[0].empty());
}

TEST(Fields, OfTheStateAreSortedWithTheirPaddingAndDerivedOnesAreLeft) {
  Sample sorted = sample(true);
  reorder_fields(sorted, std::vector<std::uint32_t>{2, 0, 1});
  EXPECT_THAT(of(sorted.x[0]), ElementsAre(2, 0, 1));
  EXPECT_THAT(of(sorted.x[1]), ElementsAre(12, 10, 11));
  EXPECT_THAT(of(sorted.p), ElementsAre(20, 21, 22));
  EXPECT_THAT(of(sorted.s.xx), ElementsAre(32, 30, 31));
  EXPECT_THAT(of(sorted.s.xy), ElementsAre(52, 50, 51));
  EXPECT_THAT(of(sorted.F[3]), ElementsAre(92, 90, 91));
  EXPECT_EQ(sorted.x[1].back(), 11) << "the padding repeats the last";

  Sample without = sample(false);
  reorder_fields(without, std::vector<std::uint32_t>{2, 0, 1});
  EXPECT_TRUE(without.F[0].empty());
}

TEST(Fields, OfTheStateGoToAStreamAndDerivedOnesStay) {
  const Sample written = sample(true);
  std::ostringstream out;
  write_states(out, written);
  EXPECT_EQ(out.str().size(), 8 + 9 * (8 + 8 * size)) << "nine components of the state";
  Sample read;
  read.p.assign(size, 7.0);
  std::istringstream in(out.str());
  read_states(in, read);
  EXPECT_EQ(read.time, 0.5);
  EXPECT_EQ(read.x, written.x);
  EXPECT_EQ(read.s.yy, written.s.yy);
  EXPECT_EQ(read.F, written.F);
  EXPECT_EQ(read.p, Field(size, 7.0));
  EXPECT_STREQ(read.x.name, "position");
}

TEST(Fields, AStreamThatEndsEarlyIsAnError) {
  std::ostringstream out;
  write_states(out, sample(true));
  std::istringstream in(out.str().substr(0, out.str().size() - 1));
  Sample read;
  EXPECT_THROW(read_states(in, read), cereal::Exception);
}

}  // namespace
}  // namespace toryu
