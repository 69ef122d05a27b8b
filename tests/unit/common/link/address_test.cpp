/// Where a process finds itself and its peers on the network.
#include "common/link/address.hpp"

#include <gmock/gmock.h>

namespace toryu {
namespace {

using testing::ElementsAre;
using testing::StartsWith;
using testing::ThrowsMessage;

TEST(Addresses, AreOfThisMachineAloneWithoutPeers) {
  const Addresses found = addresses({});
  EXPECT_EQ(found.interface, "127.0.0.1");
  EXPECT_THAT(found.peers, ElementsAre("127.0.0.1"));
}

TEST(Addresses, OfAnOwnNameThatMeansLoopbackAreThoseOfTheInterface) {
  const Addresses found = addresses({.peers = {"127.0.1.1"}});
  EXPECT_EQ(found.interface, "127.0.0.1");
  EXPECT_THAT(found.peers, ElementsAre("127.0.0.1"));
}

TEST(Addresses, OfTheInterfaceMayBeGiven) {
  EXPECT_EQ(addresses({.peers = {"localhost"}, .interface = "lo"}).interface, "lo");
  EXPECT_EQ(addresses({.peers = {"localhost"}, .interface = "127.0.0.1"}).interface, "127.0.0.1");
  EXPECT_THAT([] { addresses({.peers = {"localhost"}, .interface = "l"}); },
              ThrowsMessage<BadInput>(
                  StartsWith("--interface l: error: this machine has no such network interface with an IPv4 "
                             "address; it has lo (127.0.0.1)")));
  EXPECT_THAT(addresses({.peers = {"localhost"}}).peers, ElementsAre("127.0.0.1"));
}

TEST(Addresses, OfAHostThatNobodyKnowsAreRefused) {
  EXPECT_THAT(
      [] { addresses({.peers = {"a..b"}}); },
      ThrowsMessage<BadInput>(StartsWith("--peers a..b: error: no IPv4 address of this host is known: ")));
}

}  // namespace
}  // namespace toryu
