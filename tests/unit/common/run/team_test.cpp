#include "common/run/team.hpp"

#include <gtest/gtest.h>

namespace toryu {
namespace {

TEST(UsefulThreads, AreNoMoreThanTheMachineBears) {
  EXPECT_EQ(useful_threads(1), 1);
  EXPECT_EQ(useful_threads(16), 16) << "to compare results over numbers of threads";
  EXPECT_EQ(useful_threads(1000000), std::max(16, omp_get_num_procs()));
}

/// Lets steps pass that take `of(threads)` [s], for so long [s]; returns the time that they took at each
/// number of threads.
template <class Of>
std::vector<double> pass(ThreadChoice& choice, double seconds, Of&& of) {
  std::vector<double> spent(9, 0.0);
  for (double time = 0; time < seconds;) {
    const auto threads = static_cast<std::size_t>(choice.threads());
    const double step = of(static_cast<int>(threads));
    choice.note(step);
    spent[threads] += step;
    time += step;
  }
  return spent;
}

double quiet(int threads) {
  return 1e-3 * (threads == 1 ? 1.0 : 0.6);
}
double one_core_busy(int threads) {
  return 1e-3 * (threads == 1 ? 1.0 : 1.7);
}

TEST(ThreadChoice, StaysWithAllThreadsWhereTheyPay) {
  ThreadChoice choice(2);
  EXPECT_EQ(choice.threads(), 2);
  EXPECT_LT(pass(choice, 20, quiet)[1], 0.02 * 20) << "trials that do not pay are rare, and cut short";
}

TEST(ThreadChoice, TakesOneThreadWhereACoreIsBusyAndComesBack) {
  ThreadChoice choice(2);
  EXPECT_LT(pass(choice, 20, one_core_busy)[2], 0.03 * 20);
  EXPECT_EQ(choice.threads(), 1);
  EXPECT_LT(pass(choice, 20, quiet)[1], 0.13 * 20) << "the core is free again: noticed within two seconds";
}

TEST(ThreadChoice, NoticesAtOnceThatStepsHaveBecomeSlower) {
  ThreadChoice choice(2);
  pass(choice, 20, quiet);
  EXPECT_LT(pass(choice, 1, one_core_busy)[2], 0.25);
}

TEST(ThreadChoice, TakesTheFewerOfNumbersThatAreAlike) {
  ThreadChoice choice(2);
  EXPECT_LT(pass(choice, 10, [](int threads) { return threads == 1 ? 1e-3 : 0.99e-3; })[1], 0.1 * 10);
  pass(choice, 10, [](int) { return 1e-3; });
  EXPECT_EQ(choice.threads(), 1);
  EXPECT_LT(pass(choice, 10, [](int threads) { return threads == 1 ? 1e-3 : 0.95e-3; })[2], 0.1 * 10);
}

TEST(ThreadChoice, FindsTheNumberInBetween) {
  ThreadChoice choice(8);
  const auto spent = pass(choice, 60, [](int threads) {
    return 1e-3 * (threads == 4 ? 0.3 : threads == 8 ? 0.9 : 1.0 / threads);
  });
  EXPECT_GT(spent[4], 0.9 * 60);
}

TEST(ThreadChoice, OneThreadIsAllThereIs) {
  ThreadChoice choice(1);
  pass(choice, 10, quiet);
  EXPECT_EQ(choice.threads(), 1);
}

TEST(Team, ComputesWithAsManyThreadsAsThereAre) {
  omp_set_num_threads(2);
  int threads = 0;
  Team team;
  team.compute([&] {
#pragma omp parallel
#pragma omp single
    threads = omp_get_num_threads();
  });
  EXPECT_EQ(threads, 2);
  omp_set_num_threads(1);
}

}  // namespace
}  // namespace toryu
