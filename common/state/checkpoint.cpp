#include "common/state/checkpoint.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>
#include <zlib.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "common/error/failure.hpp"
#include "common/error/machine.hpp"
#include "common/output/atomic_file.hpp"
#include "common/run/provenance.hpp"
#include "common/sph/lanes.hpp"

namespace toryu {

namespace {

namespace fs = std::filesystem;
constexpr std::size_t kept_checkpoints = 2;
constexpr const char* folder_name = "checkpoint";
constexpr const char* manifest_name = "manifest.toml";

using Properties = std::vector<std::pair<std::string, std::string>>;

/// The instruction set, which decides how many lanes there are and whether products are fused.
std::string target() {
  return fmt::format("{} lanes{}{}", lane_count,
#if defined(__AVX512F__)
                     ", AVX-512",
#elif defined(__AVX2__)
                     ", AVX2",
#else
                     "",
#endif
#if defined(__FMA__)
                     ", FMA"
#else
                     ""
#endif
  );
}

/// A stream that keeps of what is written to it the size and the checksum, and passes it on.
class Summed : public std::ostream {
 public:
  explicit Summed(std::streambuf* to = nullptr) : std::ostream(&buffer_) { buffer_.to = to; }
  /// "SIZE CHECKSUM"
  std::string text() const { return fmt::format("{} {:08x}", buffer_.size, buffer_.sum); }
  /// Why it could not be passed on (errno).
  int error() const { return buffer_.error; }

 private:
  struct Buffer : std::streambuf {
    std::streambuf* to = nullptr;
    std::size_t size = 0;
    uLong sum = crc32(0, nullptr, 0);
    int error = 0;

    std::streamsize xsputn(const char* bytes, std::streamsize count) override {
      if (count == 0) return 0;  // of nothing, which may lie nowhere, zlib would begin anew
      sum = crc32_z(sum, reinterpret_cast<const Bytef*>(bytes), static_cast<std::size_t>(count));
      size += static_cast<std::size_t>(count);
      if (!to) return count;
      const std::streamsize passed = to->sputn(bytes, count);
      if (passed != count) error = errno != 0 ? errno : EIO;
      return passed;
    }
    int_type overflow(int_type byte) override {
      const char one = traits_type::to_char_type(byte);
      return xsputn(&one, 1) == 1 ? byte : traits_type::eof();
    }
  };
  Buffer buffer_;
};

/// Tells this program from any that was built of other sources, whatever their commit.
const std::string& build() {
  static const std::string sum = [] {
    Summed bytes;
    bytes << std::ifstream("/proc/self/exe", std::ios::binary).rdbuf();
    const std::string text = bytes.text();
    return text.substr(text.find(' ') + 1);
  }();
  return sum;
}

/// All that must be alike for the same bits to come out.
Properties properties_of(const Author& author) {
  const Provenance made = provenance(1);
  return {{"program", author.program},
          {"version", made.version},
          {"build", build() + (author.sources.empty() ? "" : " with the sources " + author.sources)},
          {"compiler", made.compiler},
          {"instruction set", target()},
          {"precision", fmt::format("{} bytes a number", sizeof(double))}};
}

constexpr const char* first_line = "toryu checkpoint part 1";

std::string header_of(const Author& author) {
  std::string text = std::string(first_line) + '\n';
  for (const auto& [name, value] : properties_of(author)) text += fmt::format("{}: {}\n", name, value);
  return text + '\n';
}

[[noreturn]] void refuse(const fs::path& place, const std::string& message) {
  throw BadInput({{.place = place.string(), .message = message}});
}

/// Numbers of the whole checkpoints, in ascending order.
std::vector<std::pair<long, fs::path>> checkpoints(const fs::path& out, bool whole) {
  std::vector<std::pair<long, fs::path>> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(out / folder_name, none)) {
    const std::string name = entry.path().filename().string();
    if (name.empty() || name.find_first_not_of("0123456789") != std::string::npos || name.size() > 9)
      continue;
    if (whole && !fs::exists(entry.path() / manifest_name)) continue;
    found.emplace_back(std::stol(name), entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Refuses a checkpoint of which `path` is damaged; says so if there is an older one.
[[noreturn]] void refuse_damaged(const fs::path& path, const std::string& how) {
  const fs::path folder = path.parent_path();
  const auto whole = checkpoints(folder.parent_path().parent_path(), true);
  refuse(path, fmt::format(
                   "is damaged: {}{}", how,
                   whole.size() < 2
                       ? ""
                       : fmt::format("; remove {} to go on from the checkpoint before it", folder.string())));
}

/// Every value of a case by its dotted key.
void flatten(const toml::node& node, const std::string& key, std::map<std::string, std::string>& found) {
  if (const auto* table = node.as_table()) {
    for (const auto& [name, value] : *table)
      flatten(value, key.empty() ? std::string(name.str()) : key + "." + std::string(name.str()), found);
  } else if (const auto* array = node.as_array(); array && array->is_array_of_tables()) {
    for (std::size_t k = 0; k < array->size(); ++k)
      flatten(*array->get(k), fmt::format("{}.{}", key, k), found);
  } else {
    std::ostringstream text;
    node.visit([&](const auto& value) {
      if constexpr (toml::is_floating_point<decltype(value)>)
        text << fmt::format("{}", value.get());
      else if constexpr (toml::is_array<decltype(value)> || toml::is_value<decltype(value)>)
        text << value;
    });
    found[key] = text.str();
  }
}

/// What a restart may change.
bool may_change(const std::string& key) {
  for (const char* free : {"case.end_time", "case.frame_interval", "case.series_interval", "case.title",
                           "case.checkpoint_interval", "case.checkpoint_every", "coupling.time_limit"})
    if (key == free) return true;
  for (const char* free : {"fluid.observer.", "solid.observer.", "reference."})
    if (key.starts_with(free)) return true;
  return false;
}

}  // namespace

std::optional<Checkpoint> newest_checkpoint(const fs::path& out) {
  const auto whole = checkpoints(out, true);
  if (whole.empty()) return {};
  const auto& [number, folder] = whole.back();
  const fs::path path = folder / manifest_name;
  try {
    const toml::table manifest = toml::parse_file(path.string());
    Checkpoint found{folder, {number, manifest["time"].value<double>().value(), {}}};
    const toml::array* parts = manifest["parts"].as_array();
    if (!parts) throw std::bad_optional_access();
    for (const auto& part : *parts) found.manifest.parts.push_back(part.value<std::string>().value());
    return found;
  } catch (const std::bad_optional_access&) {
    refuse_damaged(path, "it takes 'time', a number, and 'parts', a list of texts");
  } catch (const std::exception& failure) {
    refuse_damaged(path, failure.what());
  }
}

Checkpoint checkpoint_to_restart(const fs::path& out) {
  if (auto found = newest_checkpoint(out)) return *found;
  if (!fs::exists(out)) refuse("--restart", fmt::format("there is no folder {}", out.string()));
  if (!checkpoints(out, false).empty())
    refuse("--restart",
           fmt::format("{} holds no whole checkpoint, only one that was never completed", out.string()));
  refuse("--restart", fmt::format("{} holds no checkpoint", out.string()));
}

fs::path open_checkpoint(const fs::path& out, const fs::path& last) {
  const auto present = checkpoints(out, false);
  const long newest = present.empty() ? 0 : present.back().first;
  const long tried = last.empty() ? 0 : std::stol(last.filename().string());
  fs::path folder = out / folder_name / fmt::format("{:06}", std::max(newest, tried) + 1);
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) throw MachineFailure(fmt::format("cannot make '{}'", folder.string()), failure.value());
  return folder;
}

void complete_checkpoint(const fs::path& folder, double time, const std::string& case_text,
                         const std::vector<std::string>& parts) {
  write_atomically(folder / "case.toml", case_text);
  std::string names;
  for (const auto& part : parts) {
    if (!fs::exists(folder / (part + ".state")))
      throw std::runtime_error(fmt::format("'{}' is missing", (folder / (part + ".state")).string()));
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", part);
  }
  const std::string text = fmt::format(
      "time = {}  # s\nparts = [{}]\n",
      [&] {
        std::string number = fmt::format("{}", time);
        return number.find_first_of(".e") == std::string::npos ? number + ".0" : number;
      }(),
      names);
  write_atomically(folder / manifest_name, text);
  synchronise(folder);
  const auto whole = checkpoints(folder.parent_path().parent_path(), true);
  for (const auto& [number, old] : checkpoints(folder.parent_path().parent_path(), false))
    if (whole.size() > kept_checkpoints && number < whole[whole.size() - kept_checkpoints].first)
      abandon_checkpoint(old);
}

void abandon_checkpoint(const fs::path& folder) noexcept {
  if (folder.empty()) return;  // it could not even be made
  std::error_code ignored;     // the manifest first: what is half removed must not look whole
  fs::remove(folder / manifest_name, ignored);
  fs::remove_all(folder, ignored);
}

void write_part(const fs::path& folder, const std::string& name, const Author& author,
                const std::function<void(std::ostream&)>& write) {
  const fs::path path = folder / (name + ".state"), temporary = part_of(path);
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  if (!file) fail_to_write(temporary, errno);
  file << header_of(author);
  const auto place = file.tellp();
  constexpr int room = 40;  // for the sum, which is known when all is written
  file << fmt::format("{:{}}\n", "", room);
  Summed summed(file.rdbuf());
  try {
    write(summed);
  } catch (const std::exception&) {  // which knows of the stream alone that it takes no more
    if (summed.error() == 0) throw;
  }
  if (!summed) fail_to_write(temporary, summed.error());
  file.seekp(place);
  file << fmt::format("{:>{}}", summed.text(), room);
  file.close();
  if (!file) fail_to_write(temporary, errno);
  give_name(path);
}

void read_part(const fs::path& folder, const std::string& name, const Author& author,
               const std::function<void(std::istream&)>& read) {
  const fs::path path = folder / (name + ".state");
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!file) refuse(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  if (!std::getline(file, line) || line != first_line) refuse(path, "is no part of a checkpoint");
  std::vector<InputError> errors;
  for (const auto& [property, ours] : properties_of(author)) {
    std::getline(file, line);
    const std::string prefix = property + ": ";
    if (!line.starts_with(prefix)) refuse_damaged(path, "its head is not whole");
    if (const std::string theirs = line.substr(prefix.size()); theirs != ours)
      errors.push_back({.place = path.string(),
                        .message = fmt::format("cannot go on: its {} is {}, that of this program {}",
                                               property, theirs, ours)});
  }
  if (!errors.empty()) throw BadInput(errors);
  std::getline(file, line);
  std::size_t size = 0;
  std::string sum;
  file >> size >> sum;
  file.get();
  const auto rest = fs::file_size(path) - static_cast<std::uintmax_t>(file.tellg());
  if (!file || rest != size) refuse_damaged(path, fmt::format("it holds {} bytes of {}", rest, size));
  const auto start = file.tellg();
  Summed summed;
  if (size > 0) summed << file.rdbuf();
  if (summed.text() != fmt::format("{} {}", size, sum)) refuse_damaged(path, "its checksum is another");
  file.seekg(start);
  read(file);
}

void check_same_case(const Checkpoint& checkpoint, const std::string& case_text) {
  std::map<std::string, std::string> then, now;
  const fs::path path = checkpoint.folder / "case.toml";
  try {
    flatten(toml::parse_file(path.string()), "", then);
  } catch (const toml::parse_error& failure) {
    refuse_damaged(path, std::string(failure.description()));
  }
  flatten(toml::parse(case_text), "", now);
  std::vector<InputError> errors;
  const auto differ = [&](const std::string& key, const std::string& message) {
    if (!may_change(key))
      errors.push_back({.place = key, .message = message + ": a restart goes on with the same case"});
  };
  for (const auto& [key, value] : now)
    if (const auto old = then.find(key); old == then.end())
      differ(key, fmt::format("is {}, and was not there in the checkpoint", value));
    else if (old->second != value)
      differ(key, fmt::format("is {}, and was {} in the checkpoint", value, old->second));
  for (const auto& [key, value] : then)
    if (!now.contains(key)) differ(key, fmt::format("was {} in the checkpoint, and is not there", value));
  if (!errors.empty()) throw BadInput(errors);
}

void claim_folder(const Options& options, const std::string& participant) {
  if (options.restart) return;
  const auto exists = [&](const char* suffix) { return fs::exists(options.out / (participant + suffix)); };
  const bool holds_results =
      exists(".csv") || exists(".csv.part") || !checkpoints(options.out, false).empty();
  if (!holds_results) return;
  if (!options.overwrite)
    refuse(options.out,
           "holds the results of an earlier run: --overwrite replaces them, --restart goes on "
           "with them, --out DIR writes elsewhere");
  fs::remove_all(options.out / folder_name);
}

bool CheckpointSchedule::due(double time, double wall_time) const {
  return (interval_ > 0 && time >= last_ + interval_ * (1 - 1e-9)) ||
         (every_ > 0 && wall_time >= last_wall_ + every_);
}

void CheckpointSchedule::note(double time, double wall_time) {
  if (interval_ > 0) last_ = interval_ * std::floor(time / interval_ * (1 + 1e-12) + 1e-9);
  last_wall_ = wall_time;
}

}  // namespace toryu
