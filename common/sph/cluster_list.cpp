#include "common/sph/cluster_list.hpp"

#include <algorithm>

namespace toryu {

namespace {

constexpr std::size_t clusters_per_block = 64;

/// Appends the sources within `reach` of any of the `lane_count` targets from `first`.
void collect(const VecField& targets, std::size_t first, const VecField& sources, const StripOrder& strips,
             double reach, std::vector<std::uint32_t>& found) {
  const Lanes x_i = load(targets[0], first), y_i = load(targets[1], first);
  strips.in_box(sources[1], smallest_of(x_i) - reach, largest_of(x_i) + reach, smallest_of(y_i) - reach,
                largest_of(y_i) + reach, [&](std::size_t begin, std::size_t end) {
                  for (std::size_t j = begin; j < end; ++j) {
                    const Lanes x_ij = x_i - sources[0][j], y_ij = y_i - sources[1][j];
                    if (any_of(x_ij * x_ij + y_ij * y_ij < reach * reach))
                      found.push_back(static_cast<std::uint32_t>(j));
                  }
                });
}

}  // namespace

void ClusterList::build(const VecField& targets, std::size_t target_count, const VecField& sources,
                        const StripOrder& source_strips, double reach) {
  const std::size_t clusters = padded(target_count) / lane_count;
  const std::size_t blocks = (clusters + clusters_per_block - 1) / clusters_per_block;
  lists_.assign(clusters, {});
  if (!storage_ || storage_.use_count() > 1) storage_ = std::make_shared<Storage>();
  storage_->resize(blocks);

#pragma omp parallel for schedule(dynamic)
  for (std::size_t block = 0; block < blocks; ++block) {
    auto& found = (*storage_)[block];
    found.clear();
    const std::size_t begin = block * clusters_per_block;
    const std::size_t end = std::min(begin + clusters_per_block, clusters);
    std::array<std::size_t, clusters_per_block + 1> starts{};
    for (std::size_t c = begin; c < end; ++c) {
      collect(targets, c * lane_count, sources, source_strips, reach, found);
      starts[c - begin + 1] = found.size();
    }
    for (std::size_t c = begin; c < end; ++c)
      lists_[c] = std::span(found).subspan(starts[c - begin], starts[c - begin + 1] - starts[c - begin]);
  }

  active_.clear();
  for (std::size_t c = 0; c < clusters; ++c)
    if (!lists_[c].empty()) active_.push_back(static_cast<std::uint32_t>(c));
}

std::size_t ClusterList::pairs() const {
  std::size_t sum = 0;
  for (const auto& list : lists_) sum += list.size();
  return sum;
}

}  // namespace toryu
