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

/// Sources near a cluster whose targets are moved by `shift` [m]: by a period of space, or not at all.
struct ShiftedNeighbours {
  Vec shift = Vec::Zero();
  std::span<const std::uint32_t> sources;
};

/// A copy shares the lists until one of the two is built anew.
class ClusterList {
 public:
  /// Finds for the first `target_count` targets the sources within `reach` [m]; `source_strips` holds the
  /// index of the sources' present order. A target that is itself a source is in its own list.
  void build(const VecField& targets, std::size_t target_count, const VecField& sources,
             const StripOrder& source_strips, double reach);
  /// The same where space repeats: of each of `shifts`, the first of which is zero, what is near the targets
  /// so moved.
  void build(const VecField& targets, std::size_t target_count, const VecField& sources,
             const StripOrder& source_strips, double reach, std::span<const Vec> shifts);
  /// The same where images of the sources stand beyond y = 0, that of source j as number `first_image` + j.
  void build_with_images(const VecField& targets, std::size_t target_count, const VecField& sources,
                         const StripOrder& source_strips, double reach, std::span<const Vec> shifts,
                         std::size_t first_image);

  std::size_t clusters() const { return lists_.size(); }
  /// The first is without a shift; of the others, and of images, those that are not empty.
  std::span<const ShiftedNeighbours> near(std::size_t cluster) const { return lists_[cluster]; }
  /// Those without a shift.
  std::span<const std::uint32_t> sources(std::size_t cluster) const { return lists_[cluster][0].sources; }
  /// Clusters whose list is not empty, in order.
  const std::vector<std::uint32_t>& active() const { return active_; }
  std::size_t pairs() const;

 private:
  struct Block {
    std::vector<std::uint32_t> found;
    std::vector<ShiftedNeighbours> near;
  };
  void build_block(Block& block, std::size_t begin, std::size_t end, const VecField& targets,
                   const VecField& sources, const StripOrder& strips, double reach,
                   std::span<const Vec> shifts, std::size_t first_image);
  void build_blocks(const VecField& targets, std::size_t target_count, const VecField& sources,
                    const StripOrder& strips, double reach, std::span<const Vec> shifts,
                    std::size_t first_image);

  std::vector<std::span<const ShiftedNeighbours>> lists_;
  std::shared_ptr<std::vector<Block>> blocks_;
  std::vector<std::uint32_t> active_;
};

}  // namespace toryu
