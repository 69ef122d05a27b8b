/// Neighbours by cluster: for each `lane_count` targets in a row, the sources within reach of any of them. A
/// pair loop meets a few more sources than each target needs; beyond the kernel's support they add exact
/// zeros.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/sph/points.hpp"
#include "common/sph/strip_order.hpp"

namespace toryu {

/// A copy shares the lists until one of the two is built anew.
class ClusterList {
 public:
  /// Finds for the first `target_count` targets the sources within `reach` [m]; `source_strips` holds the
  /// index of the sources' present order. A target that is itself a source is in its own list.
  void build(const VecField& targets, std::size_t target_count, const VecField& sources,
             const StripOrder& source_strips, double reach);

  std::size_t clusters() const { return lists_.size(); }
  std::span<const std::uint32_t> sources(std::size_t cluster) const { return lists_[cluster]; }
  /// Clusters whose list is not empty, in order.
  const std::vector<std::uint32_t>& active() const { return active_; }
  std::size_t pairs() const;

 private:
  std::vector<std::span<const std::uint32_t>> lists_;
  using Storage = std::vector<std::vector<std::uint32_t>>;  ///< one a block of clusters
  std::shared_ptr<Storage> storage_;
  std::vector<std::uint32_t> active_;
};

}  // namespace toryu
