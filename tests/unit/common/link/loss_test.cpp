/// Partners that never come, fall silent, or die.
#include "link_sides.hpp"

namespace toryu {
namespace {

TEST_F(LinkTest, ASilentFluidIsNamed) {
  const LinkSettings impatient = impatient_elsewhere("coupler");
  CouplerLink coupler(impatient);
  EXPECT_THAT([&] { coupler.gather({}); },
              ThrowsMessage<PeerLost>("fluid participant did not join within 0.3 s"));
}

/// How a run ends whose fluid, a process of the given name, shows no sign of life any more.
void lose_the_fluid(const LinkSettings& settings, const std::string& process) {
  CouplerLink coupler(settings);
  std::optional<RawFluid> fluid(std::in_place, settings.out);
  fluid->process = process;
  fluid->say_hello();
  const auto lose_it = std::async(std::launch::async, [&] {
    std::this_thread::sleep_for(300ms);
    fluid.reset();
  });
  coupler.gather({});  // in vain, since there is no solid
}

TEST(Lease, OfAProcessThatRunsMayLapse) {
  LinkSettings settings;
  settings.role = "coupler";
  settings.out = std::filesystem::temp_directory_path() / fmt::format("toryu_lease_{}", getpid());
  settings.case_hash = 42;
  settings.time_limit = 30;  // the loss is seen long before, on a busy machine too
  EXPECT_THAT(
      [&] { lose_the_fluid(settings, "another_machine 1 1"); },
      ThrowsMessage<PeerLost>(HasSubstr("raw_fluid is gone, or its host or network is: no sign of life")));
  settings.time_limit = 4;  // longer than a lease and its grace
  EXPECT_THAT([&] { lose_the_fluid(settings, own_process()); },
              ThrowsMessage<PeerLost>("solid participant did not join within 4 s"));
  std::filesystem::remove_all(settings.out);
}

TEST(Death, IsNoticedThoughTheLeaseHolds) {
  LinkSettings settings;
  settings.role = "coupler";
  settings.out = std::filesystem::temp_directory_path() / fmt::format("toryu_death_{}", getpid());
  settings.case_hash = 42;
  settings.time_limit = time_limit;
  CouplerLink coupler(settings);
  RawFluid fluid(settings.out);
  fluid.process = own_process() + "0";  // had this number before, and is gone
  fluid.say_hello();
  EXPECT_THAT([&] { coupler.gather({}); },
              ThrowsMessage<PeerLost>(HasSubstr("raw_fluid was killed or stopped")));
}

TEST_F(LinkTest, AMissingCouplerIsNamed) {
  SolidLink link(impatient_elsewhere("solid"));
  EXPECT_THAT([&] { link.join(); }, ThrowsMessage<PeerLost>("coupler did not come within 0.3 s"));
}

}  // namespace
}  // namespace toryu
