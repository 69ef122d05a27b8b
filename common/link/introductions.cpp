#include "common/link/introductions.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <optional>
#include <sstream>
#include <vector>

#include "common/error/printable.hpp"
#include "common/link/dds.hpp"
#include "common/run/log.hpp"

namespace toryu::dds {

namespace {

constexpr const char* mark = "toryu introduction 1";  // of this form
constexpr int most_told = 10;                         // by strangers a log is not filled

/// Nothing if it is of no program of toryu.
std::optional<Introduction> introduction_in(const dds_qos_t* participant) {
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(participant, &data, &size) || data == nullptr) return std::nullopt;
  std::istringstream text(std::string(static_cast<const char*>(data), size));
  dds_free(data);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(printable(line));
  lines.resize(6);
  if (lines[0] != mark) return std::nullopt;
  return Introduction{lines[1], lines[2], lines[3], {lines[4], lines[5]}};
}

/// Why the two cannot take part in one run; empty if they can.
std::string difference(const Introduction& own, const Introduction& other) {
  if (own.part != "coupler" && other.part != "coupler") return "";  // they never speak to each other
  const auto &ours = own.credential.authority, &theirs = other.credential.authority;
  if (ours.empty() && theirs.empty()) return "";
  if (ours.empty())
    return "it takes certificates alone, and this program has none: give it --secure FOLDER too";
  if (theirs.empty()) return "it has no certificate, which --secure asks for";
  if (ours != theirs) return "its certificate is of another CA than that of --secure";
  if (other.credential.part != other.part)
    return fmt::format("its certificate is that of the part '{}', and it plays the part '{}'",
                       other.credential.part, other.part);
  return "";
}

std::string host_name() {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

}  // namespace

Introduction introduction(const std::string& program, const std::string& part, const Network& network) {
  return {program, fmt::format("process {} of host {}", getpid(), host_name()), part,
          credential_of(network, part)};
}

void introduce(dds_qos_t* participant, const Introduction& own) {
  const std::string text = fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n", mark, own.program, own.process, own.part,
                                       own.credential.part, own.credential.authority);
  dds_qset_userdata(participant, text.data(), text.size());
}

Introductions::Introductions(dds_entity_t participant, Introduction own)
    : own_(std::move(own)),
      reader_(dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr)) {
  require(reader_, "DCPSParticipant");
}

void Introductions::hear() {
  for (;;) {
    void* sample = nullptr;
    dds_sample_info_t info{};
    const dds_return_t count = dds_take(reader_, &sample, &info, 1, 1);
    if (count <= 0) return;
    const auto other = info.valid_data
                           ? introduction_in(static_cast<const dds_builtintopic_participant_t*>(sample)->qos)
                           : std::nullopt;
    dds_return_loan(reader_, &sample, count);
    if (!other) continue;
    const std::string why = difference(own_, *other);
    if (why.empty()) continue;
    const std::string reason = fmt::format("{}, {}: {}", other->program, other->process, why);
    if (++told_ <= most_told) log::warn("refused {}", reason);
    const bool has_part = other->part == "coupler" || other->part == "fluid" || other->part == "solid";
    if (has_part && !refusals_.contains(other->part)) refusals_[other->part] = {reason, Clock::now()};
  }
}

const Introductions::Refusal* Introductions::refusal_of(const std::string& part) const {
  const auto found = refusals_.find(part);
  return found == refusals_.end() ? nullptr : &found->second;
}

}  // namespace toryu::dds
