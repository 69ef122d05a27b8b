/// Where the time of a run goes: named parts, summed over the run, named by the code that does the work.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

namespace toryu {

class Timers {
 public:
  struct Part {
    std::string name;
    double seconds = 0;
    long calls = 0;
  };

  /// Adds the time from construction to destruction to a part.
  class Scope {
   public:
    explicit Scope(Part& part) : part_(part), start_(std::chrono::steady_clock::now()) {}
    ~Scope() {
      part_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
      ++part_.calls;
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Part& part_;
    std::chrono::steady_clock::time_point start_;
  };

  /// `auto t = timers.measure("density gradient");` `name` must be a literal or outlive nothing: it is copied
  /// once.
  [[nodiscard]] Scope measure(const char* name) {
    for (auto& part : parts_)
      if (part.name == name) return Scope(part);
    parts_.reserve(64);  // references held by open scopes stay valid
    return Scope(parts_.emplace_back(Part{name}));
  }
  const std::vector<Part>& parts() const { return parts_; }
  double seconds(const std::string& name) const {
    for (const auto& part : parts_)
      if (part.name == name) return part.seconds;
    return 0;
  }

 private:
  std::vector<Part> parts_;
};

/// Parts of two times of a run; those of one name are one part.
inline std::vector<Timers::Part> sum_of(std::vector<Timers::Part> before,
                                        const std::vector<Timers::Part>& after) {
  for (const auto& part : after) {
    const auto same = std::find_if(before.begin(), before.end(),
                                   [&](const Timers::Part& other) { return other.name == part.name; });
    if (same == before.end()) {
      before.push_back(part);
    } else {
      same->seconds += part.seconds;
      same->calls += part.calls;
    }
  }
  return before;
}

template <class Archive>
void serialize(Archive& archive, Timers::Part& part) {
  auto& [name, seconds, calls] = part;
  archive(name, seconds, calls);
}

}  // namespace toryu
