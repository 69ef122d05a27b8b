/// `detached.csv`: a row a particle that has come off, in the order of time. It is there, if empty, in every
/// run that looks for such particles, and complete at any moment: it is always written whole, so that a run
/// that goes on from a checkpoint doubles and misses none.
#pragma once

#include <filesystem>
#include <vector>

#include "common/loop/series_columns.hpp"
#include "solid_solver/detachment.hpp"

namespace toryu::solid {

class DetachedList {
 public:
  static SeriesColumns columns();
  explicit DetachedList(const std::filesystem::path& out);
  /// Writes all that have come off so far, and warns in the log: of the first few one by one, then
  /// whenever they have doubled.
  void write(const std::vector<DetachedParticle>& all);

 private:
  std::filesystem::path path_;
  std::size_t warned_ = 0;  ///< of so many
};

}  // namespace toryu::solid
