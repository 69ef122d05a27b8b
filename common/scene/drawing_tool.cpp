#include "common/scene/drawing_tool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include "common/case/text_file.hpp"
#include "common/case/text_hash.hpp"
#include "common/case/user_cache.hpp"

namespace toryu {

namespace {

namespace fs = std::filesystem;

/// Debian's own, which has the packages, whatever python3 is first on PATH.
constexpr const char* python = "/usr/bin/python3";
constexpr int ended_well = 0;                       // exit code
constexpr std::chrono::seconds time_limit{120};     // for a drawing
constexpr std::size_t largest_answer = 64'000'000;  // [bytes]

/// tools/toryu of the tree that the program was built in; empty if it is in none.
fs::path tools_folder() {
  std::error_code none;
  for (fs::path place = fs::read_symlink("/proc/self/exe", none); place.has_relative_path();) {
    place = place.parent_path();
    if (is_file(place / "tools/toryu/outline.py")) return place / "tools/toryu";
  }
  return {};
}

/// Where an answer is kept; empty if the user has no such place.
fs::path cached_answer(const fs::path& tools, const std::string& text,
                       const std::vector<std::string>& arguments) {
  TextHash hash;
  hash.add(text);
  hash.add(read_text(tools / "outline.py", largest_case));
  for (const auto& argument : arguments) hash.add(argument);
  return cached_file(fmt::format("outline_{:016x}.csv", hash.value()));
}

/// A child process and the end of the pipe that its standard output goes to.
class Child {
 public:
  explicit Child(std::vector<std::string> words) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) {
      error_ = errno;
      return;
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    error_ = posix_spawn(&process_, python, &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    output_ = ends[0];
  }
  ~Child() {
    if (output_ >= 0) close(output_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int error() const { return error_; }
  /// All that it writes; it is killed if that is too much or takes too long.
  std::string output() {
    const auto end = std::chrono::steady_clock::now() + time_limit;
    std::string text;
    char part[65536];
    while (text.size() < largest_answer && std::chrono::steady_clock::now() < end) {
      pollfd wanted{output_, POLLIN, 0};
      if (poll(&wanted, 1, 1000) <= 0) continue;
      const ssize_t count = read(output_, part, sizeof(part));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return text;
      text.append(part, static_cast<std::size_t>(count));
    }
    kill(process_, SIGKILL);
    return "";
  }
  /// Its exit code; -1 if a signal ended it.
  int wait() const {
    int status = 0;
    while (waitpid(process_, &status, 0) < 0)
      if (errno != EINTR) return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t process_ = -1;
  int output_ = -1, error_ = 0;
};

ToolAnswer answer_of(const fs::path& tools, const fs::path& path, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{python, "-I", "-X", "utf8", tools.string(), "outline"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  words.insert(words.end(), {"--", path.string()});
  Child child(std::move(words));
  if (child.error() != 0)
    return {.rows = {},
            .key = "file",
            .fault = fmt::format("cannot be read: {} cannot be started: {}", python,
                                 std::strerror(child.error()))};
  std::string text = child.output();
  const int code = child.wait();
  if (code == ended_well) return {.rows = std::move(text), .key = {}, .fault = {}};
  const auto tab = text.find('\t');
  if (tab != std::string::npos)
    return {.rows = {}, .key = text.substr(0, tab), .fault = text.substr(tab + 1, text.find('\n') - tab - 1)};
  return {.rows = {},
          .key = "file",
          .fault = code < 0 ? "cannot be read: the program that reads it was killed, or took too long"
                            : fmt::format("cannot be read: the program that reads it ended with {}", code)};
}

}  // namespace

ToolAnswer ask_drawing_tool(const fs::path& path, const std::string& text,
                            const std::vector<std::string>& arguments) {
  const fs::path tools = tools_folder();
  if (tools.empty())
    return {.rows = {},
            .key = "file",
            .fault = "cannot be read: there is no tools/toryu/outline.py in a folder above the program"};
  const fs::path cached = cached_answer(tools, text, arguments);
  if (auto rows = read_cached(cached)) return {.rows = std::move(*rows), .key = {}, .fault = {}};
  ToolAnswer answer = answer_of(tools, path, arguments);
  if (answer.fault.empty()) keep_cached(cached, answer.rows);
  return answer;
}

}  // namespace toryu
