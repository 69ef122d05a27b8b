/// A thin layer over the C interface of Cyclone DDS: where the processes of a run meet, and typed writers and
/// readers that turn return codes into exceptions. One quality of service serves all topics: reliable, the
/// newest sample kept for late joiners, and a lease by which a dead writer is noticed.
#pragma once

#include <dds/dds.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/link/introductions.hpp"
#include "common/link/seal.hpp"
#include "common/link/spin.hpp"
#include "common/run/network.hpp"

namespace toryu::dds {

/// Signs of life of a process end this long after its death [ms].
inline constexpr int lease_ms = 500;
/// How long a lease may lapse before its owner counts as dead if its process is not seen to run, where it may
/// be silent for `lost_after` [s]: a busy machine is late at times.
constexpr std::chrono::duration<double> grace(double lost_after) {
  return std::chrono::duration<double>(lost_after - 1e-3 * lease_ms);
}

/// Processes meet if they agree on domain, tag and key: the domain sets the ports, the tag keeps runs apart
/// that share them, the key seals their messages.
struct Rendezvous {
  std::uint32_t domain;
  std::string tag;
  std::uint64_t key;
  Network network;
};

/// Follows from the secret in the results folder, so that programs started by hand find each other and nobody
/// else does: neither who has a folder of the same path elsewhere, nor who kept messages of an earlier run.
/// Over hosts, each has a copy of the secret.
Rendezvous rendezvous(const std::filesystem::path& out, const Network& network = {});

/// Random and never 0: names a process or a run.
std::uint64_t random_id();

/// Whose messages a reader takes that does not listen to one process alone.
inline constexpr std::uint64_t anybody = 0;

/// Who takes a seat: the program, and its part in the run, "coupler", "fluid" or "solid".
struct Occupant {
  std::string program, part;
};

/// This process's seat in a run: the DDS participant and all that hangs on it, deleted together.
class Node {
 public:
  Node(const Rendezvous& place, const Occupant& occupant);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  dds_entity_t make_writer(const dds_topic_descriptor_t& type, const std::string& topic);
  dds_entity_t make_reader(const dds_topic_descriptor_t& type, const std::string& topic);
  /// Blocks until a reader has news since the last call, or the time is over; false if it is.
  bool wait(std::chrono::milliseconds longest) const;
  /// The same, but that it looks for them as long as `waiting` may spin before it sleeps.
  bool wait(std::chrono::milliseconds longest, SpinningWait& waiting) const;
  /// The sender of what is written here, and the key of all that is written and read.
  std::uint64_t id() const { return id_; }
  std::uint64_t key() const { return key_; }
  /// Takes note of a message that was refused, and tells of the first.
  void note_refused(const std::string& topic);
  /// What the others of the run say of themselves in the open.
  Introductions& introductions() { return *introductions_; }
  /// Throws what explains a silence: PeerLost if another process offers or asks for a topic on terms that can
  /// never match, BadInput if with messages of another shape, or if the identity of --secure has expired.
  void explain_silence() const;

 private:
  dds_entity_t make_topic(const dds_topic_descriptor_t& type, const std::string& topic) const;
  bool has_news() const;
  void note_news() const;
  struct Endpoint {
    dds_entity_t entity;
    std::string topic;
    bool reads;
  };
  const std::uint64_t id_ = random_id(), key_;
  std::uint64_t refused_ = 0;
  std::shared_ptr<const dds_entity_t> domain_;
  dds_entity_t participant_ = 0;
  Expiry expiry_;
  std::optional<Introductions> introductions_;
  dds_entity_t waitset_ = 0;
  std::vector<Endpoint> endpoints_;
};

/// The generated description of a message type.
template <class Message>
const dds_topic_descriptor_t& descriptor();
template <>
inline const dds_topic_descriptor_t& descriptor<toryu_Hello>() {
  return toryu_Hello_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<toryu_Session>() {
  return toryu_Session_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<toryu_Status>() {
  return toryu_Status_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<toryu_Interface>() {
  return toryu_Interface_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<toryu_Motion>() {
  return toryu_Motion_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<toryu_Load>() {
  return toryu_Load_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<toryu_CheckpointRequest>() {
  return toryu_CheckpointRequest_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<toryu_CheckpointReport>() {
  return toryu_CheckpointReport_desc;
}

/// Throws PeerLost for a time-out and std::runtime_error for any other fault of a call on `topic`.
void require(dds_return_t code, const std::string& topic);

/// Throws PeerLost: a message of a process of this run does not say what was sent.
[[noreturn]] void throw_damaged(const std::string& topic);

template <class Message>
class Writer {
 public:
  Writer(Node& node, std::string topic)
      : node_(node), topic_(std::move(topic)), entity_(node.make_writer(descriptor<Message>(), topic_)) {}
  /// Copies the message, with its sender and seal; may block up to a second if the reader's process is
  /// stopped.
  void write(Message message) {
    message.sender = node_.id();
    message.seal = seal_of(message, node_.key());
    require(dds_write(entity_, &message), topic_);
  }
  /// Waits until every reader has all that was written, at most `longest`.
  void flush(std::chrono::milliseconds longest) noexcept {
    dds_wait_for_acks(entity_, DDS_MSECS(longest.count()));
  }

 private:
  const Node& node_;
  std::string topic_;
  dds_entity_t entity_;
};

template <class Message>
class Reader {
 public:
  /// Takes messages of the sender that `from` names, of anybody while it is 0.
  Reader(Node& node, std::string topic, const std::uint64_t& from = anybody)
      : node_(node),
        from_(from),
        topic_(std::move(topic)),
        entity_(node.make_reader(descriptor<Message>(), topic_)) {}

  /// Hands one new message to `use`; false if there was none. The message lives during the call only. What
  /// comes from another sender, or from nobody known without the seal of the run, is passed over and counted.
  /// Throws PeerLost if a message of the sender was damaged.
  template <class Use>
  bool take(Use&& use) {
    for (;;) {
      const Loan loan(*this);
      if (loan.count == 0) return false;
      if (!loan.info.valid_data) continue;  // news of a writer's end, not a message
      const auto& message = *static_cast<const Message*>(loan.sample);
      if (!admits(message)) continue;
      age_ = std::chrono::nanoseconds(dds_time() - loan.info.source_timestamp);
      use(message);
      return true;
    }
  }

  /// How long ago the message taken last was written, by the clocks of both machines.
  std::chrono::nanoseconds age() const { return age_; }

  /// Writers of the topic that show signs of life.
  std::uint32_t live_writers() const {
    dds_liveliness_changed_status_t status{};
    require(dds_get_liveliness_changed_status(entity_, &status), topic_);
    return status.alive_count;
  }

 private:
  bool admits(const Message& message) {
    const bool sealed = message.seal == seal_of(message, node_.key());
    if (sealed && (from_ == anybody || message.sender == from_)) return true;
    if (!sealed && from_ != anybody && message.sender == from_) throw_damaged(topic_);
    node_.note_refused(topic_);
    return false;
  }

  struct Loan {
    explicit Loan(const Reader& from) : reader(from) {
      count = dds_take(reader.entity_, &sample, &info, 1, 1);
      require(count, reader.topic_);
    }
    ~Loan() {
      if (count > 0) dds_return_loan(reader.entity_, &sample, count);
    }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    const Reader& reader;
    void* sample = nullptr;
    dds_sample_info_t info{};
    dds_return_t count = 0;
  };
  Node& node_;
  const std::uint64_t& from_;
  std::string topic_;
  dds_entity_t entity_;
  std::chrono::nanoseconds age_{0};
};

}  // namespace toryu::dds
