#include "common/sph/cluster_list.hpp"

#include <algorithm>

namespace toryu {

namespace {

constexpr std::size_t clusters_per_block = 64;

/// Appends the sources within `reach` of any of the `lane_count` targets at `x_i`.
void collect(const VecLanes& x_i, const VecField& sources, const StripOrder& strips, double reach,
             std::vector<std::uint32_t>& found) {
  static_assert(dim == 2, "boxes and distances of the plane");
  strips.in_box(sources[1], smallest_of(x_i[0]) - reach, largest_of(x_i[0]) + reach,
                smallest_of(x_i[1]) - reach, largest_of(x_i[1]) + reach,
                [&](std::size_t begin, std::size_t end) {
                  for (std::size_t j = begin; j < end; ++j) {
                    const Lanes x_ij = x_i[0] - sources[0][j], y_ij = x_i[1] - sources[1][j];
                    if (any_of(x_ij * x_ij + y_ij * y_ij < reach * reach))
                      found.push_back(static_cast<std::uint32_t>(j));
                  }
                });
}

VecLanes beyond_axis(const VecLanes& x) {
  return {x[0], -x[1]};
}

}  // namespace

void ClusterList::build_block(Block& block, std::size_t begin, std::size_t end, const VecField& targets,
                              const VecField& sources, const StripOrder& strips, double reach,
                              std::span<const Vec> shifts, std::size_t first_image) {
  // They grow here, and the block takes what there is: it would keep up to twice as much.
  static thread_local std::vector<std::uint32_t> found;
  static thread_local std::vector<std::size_t> ends;  // of each of `near` in `found`
  found.clear();
  ends.clear();
  block.near.clear();
  std::array<std::size_t, clusters_per_block + 1> first{};  // of each cluster in `near`
  for (std::size_t c = begin; c < end; ++c) {
    const VecLanes x_i = load(targets, c * lane_count);
    for (std::size_t k = 0; k < shifts.size(); ++k) {
      const std::size_t before = found.size();
      collect(shifted(x_i, shifts[k]), sources, strips, reach, found);
      if (k > 0 && found.size() == before) continue;
      block.near.push_back({shifts[k], {}});
      ends.push_back(found.size());
    }
    for (std::size_t k = 0; first_image > 0 && k < shifts.size(); ++k) {
      const std::size_t before = found.size();
      collect(beyond_axis(shifted(x_i, shifts[k])), sources, strips, reach, found);
      if (found.size() == before) continue;
      for (std::size_t j = before; j < found.size(); ++j) found[j] += static_cast<std::uint32_t>(first_image);
      block.near.push_back({shifts[k], {}});
      ends.push_back(found.size());
    }
    first[c - begin + 1] = block.near.size();
  }
  // where the vectors lie is known only now that they do not grow any more
  block.found.assign(found.begin(), found.end());
  std::size_t start = 0;
  for (std::size_t k = 0; k < block.near.size(); start = ends[k++])
    block.near[k].sources = std::span(block.found).subspan(start, ends[k] - start);
  for (std::size_t c = begin; c < end; ++c)
    lists_[c] = std::span(block.near).subspan(first[c - begin], first[c - begin + 1] - first[c - begin]);
}

void ClusterList::build(const VecField& targets, std::size_t target_count, const VecField& sources,
                        const StripOrder& source_strips, double reach) {
  const Vec unshifted = Vec::Zero();
  build(targets, target_count, sources, source_strips, reach, std::span(&unshifted, 1));
}

void ClusterList::build(const VecField& targets, std::size_t target_count, const VecField& sources,
                        const StripOrder& source_strips, double reach, std::span<const Vec> shifts) {
  build_blocks(targets, target_count, sources, source_strips, reach, shifts, 0);
}

void ClusterList::build_with_images(const VecField& targets, std::size_t target_count,
                                    const VecField& sources, const StripOrder& source_strips, double reach,
                                    std::span<const Vec> shifts, std::size_t first_image) {
  build_blocks(targets, target_count, sources, source_strips, reach, shifts, first_image);
}

void ClusterList::build_blocks(const VecField& targets, std::size_t target_count, const VecField& sources,
                               const StripOrder& strips, double reach, std::span<const Vec> shifts,
                               std::size_t first_image) {
  const std::size_t clusters = padded(target_count) / lane_count;
  lists_.assign(clusters, {});
  if (!blocks_ || blocks_.use_count() > 1) blocks_ = std::make_shared<std::vector<Block>>();
  blocks_->resize((clusters + clusters_per_block - 1) / clusters_per_block);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t b = 0; b < blocks_->size(); ++b)
    build_block((*blocks_)[b], b * clusters_per_block, std::min((b + 1) * clusters_per_block, clusters),
                targets, sources, strips, reach, shifts, first_image);

  active_.clear();
  for (std::size_t c = 0; c < clusters; ++c)
    if (lists_[c].size() > 1 || !lists_[c][0].sources.empty())
      active_.push_back(static_cast<std::uint32_t>(c));
}

std::size_t ClusterList::pairs() const {
  std::size_t sum = 0;
  for (const auto& list : lists_)
    for (const ShiftedNeighbours& near : list) sum += near.sources.size();
  return sum;
}

}  // namespace toryu
