#include "common/case/nearest_word.hpp"

#include <gtest/gtest.h>

namespace toryu {
namespace {

TEST(EditDistance, CountsEachKindOfEditOnce) {
  EXPECT_EQ(edit_distance("density", "density"), 0);
  EXPECT_EQ(edit_distance("densty", "density"), 1);    // insert
  EXPECT_EQ(edit_distance("densitty", "density"), 1);  // delete
  EXPECT_EQ(edit_distance("dentity", "density"), 1);   // replace
  EXPECT_EQ(edit_distance("denisty", "density"), 1);   // swap
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("ca", "abc"), 3);  // 2 if a swapped pair could be edited again
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(NearestWord, IsTheFirstOfTheNearest) {
  EXPECT_EQ(nearest_word("alpa", {"beta", "alpha", "alpaca"}), "alpha");
  EXPECT_EQ(nearest_word("bat", {"bet", "bit"}), "bet");
}

TEST(NearestWord, IsNoneIfAThirdOfTheLettersWouldNotDo) {
  EXPECT_EQ(nearest_word("gamma", {"beta", "alpha"}), "");
  EXPECT_EQ(nearest_word("abcxyz", {"abcdef"}), "");
  EXPECT_EQ(nearest_word("abcdyz", {"abcdef"}), "abcdef");
  EXPECT_EQ(nearest_word("x", {}), "");
}

TEST(DidYouMean, IsPartOfASentence) {
  EXPECT_EQ(did_you_mean("alpa", {"alpha"}), "; did you mean 'alpha'?");
  EXPECT_EQ(did_you_mean("gamma", {"alpha"}), "");
  EXPECT_EQ(quoted_list({"a", "b"}), "'a', 'b'");
}

TEST(WhatThereIs, IsTheNearestNameOrAll) {
  EXPECT_EQ(what_there_is("hub", {}), "; there is none");
  EXPECT_EQ(what_there_is("hab", {"hub", "piston"}), "; did you mean 'hub'?");
  EXPECT_EQ(what_there_is("x", {"hub", "piston"}), "; there are 'hub', 'piston'");
}

}  // namespace
}  // namespace toryu
