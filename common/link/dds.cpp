#include "common/link/dds.hpp"

#include <arpa/inet.h>
#include <dds/ddsrt/log.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <random>
#include <stdexcept>
#include <thread>

#include "common/error/failure.hpp"
#include "common/error/machine.hpp"
#include "common/link/address.hpp"
#include "common/link/identity.hpp"
#include "common/link/run_secret.hpp"
#include "common/link/security.hpp"
#include "common/run/log.hpp"

namespace toryu::dds {

namespace {

/// The fastest of the measured configurations for three processes on one machine: one interface, unicast, one
/// fragment for messages below 64 kB. A lost announcement is repeated after a second. Writers do not linger
/// for readers that died: what must arrive before an end is flushed by us. The ports of a domain are 250, two
/// a process: 40 runs find room in one, for the price of 120 small datagrams a second, process and host. What
/// is known of a process that falls silent outlives the limit after which it is lost.
constexpr const char* configuration = R"(<CycloneDDS><Domain>
  <General>
    <Interfaces><NetworkInterface {}="{}"/></Interfaces>
    <AllowMulticast>false</AllowMulticast>
    <MaxMessageSize>65000B</MaxMessageSize>
    <FragmentSize>64000B</FragmentSize>
  </General>
  <Discovery>
    <Tag>{}</Tag>
    <SPDPInterval>1s</SPDPInterval>
    <ParticipantIndex>auto</ParticipantIndex>
    <MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex>
    <LeaseDuration>{:.0f}ms</LeaseDuration>
    <Peers>{}</Peers>
  </Discovery>
  <Internal><WriterLingerDuration>0s</WriterLingerDuration></Internal>
</Domain></CycloneDDS>)";

constexpr double spare_lease = 7;                       // [s] beyond the limit
constexpr std::chrono::milliseconds until_heard{1200};  // a little more than SPDPInterval

/// Announcements go to each place that a process may have on a host, whether there is one or not. Where a
/// host cannot be reached they fill the buffer of the socket, and with those of 120 places a process blocked
/// in its end for longer than 20 s.
int last_place(const Network& network) {
  return network.peers.empty() ? 119 : 9;
}

std::string configuration_of(const Rendezvous& place, const Addresses& addresses) {
  std::string peers;
  for (const std::string& peer : addresses.peers) peers += fmt::format(R"(<Peer Address="{}"/>)", peer);
  const bool is_address = std::isdigit(static_cast<unsigned char>(addresses.interface.front())) != 0;
  return fmt::format(configuration, is_address ? "address" : "name", addresses.interface, place.tag,
                     last_place(place.network), 1e3 * (place.network.lost_after + spare_lease), peers);
}

std::string last_words;  ///< Cyclone's last error, which says more than its return code

/// Cyclone's own words go to our log; its warnings (such as: lo has no multicast) are of no use to a user.
void log_sink(void*, const dds_log_data_t* data) {
  std::string text(data->message, data->size);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const bool error = (data->priority & (DDS_LC_FATAL | DDS_LC_ERROR)) != 0;
  if (error) last_words = text;
  log::write(log::Level::debug, fmt::format("Cyclone DDS: {}", text));
}

/// Whether this machine can talk to itself: that is all the link needs of a network.
void require_loopback() {
  sockaddr_in self{};
  self.sin_family = AF_INET;
  self.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int made = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const bool works =
      made >= 0 && bind(made, reinterpret_cast<sockaddr*>(&self), sizeof self) == 0 &&
      (self.sin_port = htons(7400), connect(made, reinterpret_cast<sockaddr*>(&self), sizeof self) == 0);
  const int reason = errno;
  if (made >= 0) close(made);
  if (works) return;
  throw MachineFailure(fmt::format(
      "the programs of a coupled run talk over the loopback address 127.0.0.1, which does not work "
      "here: {}; 'ip address add 127.0.0.1/8 dev lo; ip link set lo up' sets it up",
      std::strerror(reason)));
}

/// Throws for what cannot be set up in the domain `place`.
void require_set_up(dds_return_t code, const Rendezvous& place) {
  if (code >= 0) return;
  const int first_port = 7400 + 250 * static_cast<int>(place.domain);
  throw MachineFailure(fmt::format(
      "the programs of a coupled run cannot meet: {}; they need a pair of UDP ports each, of {} to {} on "
      "{}: end what holds those ('ss -uanp' shows it), or {}",
      last_words.empty() ? dds_strretcode(code) : last_words, first_port,
      first_port + 11 + 2 * last_place(place.network), addresses(place.network).interface,
      place.network.domain ? "give another --domain" : "start again, which takes others"));
}

/// A domain can be made once in a process; the nodes in it share it.
std::shared_ptr<const dds_entity_t> join_domain(const Rendezvous& place) {
  static std::mutex mutex;
  static std::map<std::uint32_t, std::weak_ptr<const dds_entity_t>> domains;
  const std::lock_guard lock(mutex);
  if (auto domain = domains[place.domain].lock()) return domain;
  if (place.network.peers.empty()) require_loopback();
  dds_set_log_sink(log_sink, nullptr);
  const std::string text = configuration_of(place, addresses(place.network));
  const dds_entity_t entity = dds_create_domain(place.domain, text.c_str());
  require_set_up(entity, place);
  std::shared_ptr<const dds_entity_t> domain(new dds_entity_t(entity), [](const dds_entity_t* made) {
    dds_delete(*made);
    delete made;
  });
  domains[place.domain] = domain;
  return domain;
}

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

/// Reader and writer share all but the lease, which the writer grants and the reader takes as it comes.
Qos quality(bool writes) {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
  dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  if (writes) dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, DDS_MSECS(lease_ms));
  return qos;
}

}  // namespace

void require(dds_return_t code, const std::string& topic) {
  if (code >= 0) return;
  if (code == DDS_RETCODE_TIMEOUT)
    throw PeerLost(fmt::format("no reader of '{}' took a message within a second", topic));
  throw std::runtime_error(fmt::format("Cyclone DDS, {}: {}", topic, dds_strretcode(code)));
}

void throw_damaged(const std::string& topic) {
  throw PeerLost(fmt::format("a message of '{}' was damaged on its way: its check sum is wrong", topic));
}

Rendezvous rendezvous(const std::filesystem::path& out, const Network& network) {
  const RunSecret secret = run_secret(out);
  const std::uint64_t by_chance = 1 + secret.name % last_domain;
  return {
      static_cast<std::uint32_t>(network.domain ? static_cast<std::uint64_t>(*network.domain) : by_chance),
      fmt::format("toryu-{:016x}", secret.name), secret.key, network};
}

std::uint64_t random_id() {
  std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32 | device()) | 1;
}

Node::Node(const Rendezvous& place, const Occupant& occupant) : key_(place.key), domain_(join_domain(place)) {
  const Introduction own = introduction(occupant.program, occupant.part, place.network);
  const Qos qos(dds_create_qos());
  introduce(qos.get(), own);
  const auto join = [&] {
    participant_ = dds_create_participant(place.domain, qos.get(), nullptr);
    require_set_up(participant_, place);
  };
  try {
    expiry_ = check_identity(place.network, occupant.part);
  } catch (const BadInput&) {
    join();  // so that the others can name it too, which cannot take it for one of them
    std::this_thread::sleep_for(until_heard);
    throw;
  }
  if (!place.network.secure.empty()) set_identity(qos.get(), place.network.secure, occupant.part);
  join();
  introductions_.emplace(participant_, own);
  waitset_ = dds_create_waitset(participant_);
  require(waitset_, "waitset");
}

Node::~Node() {
  dds_delete(participant_);
  if (refused_ > 1) log::warn("refused {} messages that are not of this run", refused_);
}

void Node::note_refused(const std::string& topic) {
  if (++refused_ == 1)
    log::warn("refused a message of '{}' that is not of this run; further ones are counted in silence",
              topic);
}

dds_entity_t Node::make_topic(const dds_topic_descriptor_t& type, const std::string& topic) const {
  const dds_entity_t entity = dds_create_topic(participant_, &type, topic.c_str(), nullptr, nullptr);
  require(entity, topic);
  return entity;
}

dds_entity_t Node::make_writer(const dds_topic_descriptor_t& type, const std::string& topic) {
  const dds_entity_t entity =
      dds_create_writer(participant_, make_topic(type, topic), quality(true).get(), nullptr);
  require(entity, topic);
  endpoints_.push_back({entity, topic, false});
  return entity;
}

dds_entity_t Node::make_reader(const dds_topic_descriptor_t& type, const std::string& topic) {
  const dds_entity_t entity =
      dds_create_reader(participant_, make_topic(type, topic), quality(false).get(), nullptr);
  require(entity, topic);
  require(dds_set_status_mask(entity, DDS_DATA_AVAILABLE_STATUS), topic);
  require(dds_waitset_attach(waitset_, entity, entity), topic);
  endpoints_.push_back({entity, topic, true});
  return entity;
}

bool Node::wait(std::chrono::milliseconds longest) const {
  const dds_return_t triggered = dds_waitset_wait(waitset_, nullptr, 0, DDS_MSECS(longest.count()));
  require(triggered, "waitset");
  if (triggered > 0) note_news();
  return triggered > 0;
}

bool Node::wait(std::chrono::milliseconds longest, SpinningWait& waiting) const {
  if (!waiting.look([this] { return has_news(); })) return wait(longest);
  note_news();
  return true;
}

bool Node::has_news() const {
  for (const Endpoint& endpoint : endpoints_) {
    std::uint32_t status = 0;
    if (endpoint.reads) require(dds_get_status_changes(endpoint.entity, &status), endpoint.topic);
    if ((status & DDS_DATA_AVAILABLE_STATUS) != 0) return true;
  }
  return false;
}

/// Told once: what nobody takes yet (a message come early, the notice that a writer lapsed) must not end the
/// next wait too, or this process would spin until somebody does.
void Node::note_news() const {
  for (const Endpoint& endpoint : endpoints_) {
    std::uint32_t status = 0;
    if (endpoint.reads)
      require(dds_take_status(endpoint.entity, &status, DDS_DATA_AVAILABLE_STATUS), endpoint.topic);
  }
}

void Node::explain_silence() const {
  check_expiry(expiry_);
  for (const Endpoint& endpoint : endpoints_) {
    std::uint32_t count = 0, policy = 0;
    if (endpoint.reads) {
      dds_requested_incompatible_qos_status_t status{};
      require(dds_get_requested_incompatible_qos_status(endpoint.entity, &status), endpoint.topic);
      count = status.total_count, policy = status.last_policy_id;
    } else {
      dds_offered_incompatible_qos_status_t status{};
      require(dds_get_offered_incompatible_qos_status(endpoint.entity, &status), endpoint.topic);
      count = status.total_count, policy = status.last_policy_id;
    }
    if (count > 0 && policy == DDS_TYPE_CONSISTENCY_ENFORCEMENT_QOS_POLICY_ID)
      throw BadInput({{.place = endpoint.topic,
                       .message = "another process speaks another protocol, with messages of another shape; "
                                  "take programs of one version"}});
    if (count > 0)
      throw PeerLost(
          fmt::format("another process speaks of '{}' with another quality of service (DDS policy {}): no "
                      "message can pass",
                      endpoint.topic, policy));
  }
}

}  // namespace toryu::dds
