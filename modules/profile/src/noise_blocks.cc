#include "noise_blocks.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/nan.h"

namespace asperity {

namespace {

constexpr std::size_t kBlock_points = 20;
constexpr double kStudent = 2.0;  // an error over a sigma from n draws has the variance n/(n − 2): Student's
constexpr double kTypical = 0.9;  // of the path: slow ends and rests have another noise, and are a few of its per cent

double mean_present(std::span<const double> x) {
  double sum = 0.0, count = 0.0;
  for (const double v : x) {
    if (!std::isfinite(v)) continue;
    sum += v;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : kNan;
}

}  // namespace

double mean_square(std::span<const double> x) {
  double sum = 0.0, count = 0.0;
  for (const double v : x) {
    if (!std::isfinite(v)) continue;
    sum += v * v;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : kNan;
}

std::vector<Block> find_blocks(const Profile& profile) {
  std::vector<Block> out;
  double known_mmps = 0.0;
  for (std::size_t first = 0; first < profile.size(); first += kBlock_points) {
    Block block;
    block.first = first;
    block.last = std::min(first + kBlock_points, profile.size());
    const auto part = [&](std::span<const double> x) { return x.subspan(first, block.last - first); };
    for (const double h : part(profile.texture_m)) block.points += std::isfinite(h) ? 1.0 : 0.0;
    const double speed_mmps = 1e3 * std::abs(mean_present(part(profile.speed_mps)));
    if (speed_mmps > 0.0) {
      if (known_mmps == 0.0) std::for_each(out.begin(), out.end(), [&](Block& b) { b.speed_mmps = speed_mmps; });
      known_mmps = speed_mmps;
    }
    block.speed_mmps = known_mmps;
    if (block.points > 0.0) out.push_back(block);
  }
  if (known_mmps == 0.0) out.clear();
  return out;
}

BlockErrors over_blocks(const Profile& profile, const std::vector<Block>& blocks,
                        const std::vector<std::vector<double>>& draws) {
  BlockErrors out;
  out.block_m2.assign(blocks.size(), 0.0);
  const auto count = static_cast<double>(draws.size());
  double square = 0.0;
  for (const std::vector<double>& draw : draws) {
    double sum = 0.0, points = 0.0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      double block = 0.0;
      for (std::size_t i = blocks[b].first; i < blocks[b].last; ++i) {
        if (std::isfinite(profile.texture_m[i])) block += draw[i] * draw[i];
      }
      out.block_m2[b] += block / (blocks[b].points * (count - kStudent));
      sum += block;
      points += blocks[b].points;
    }
    out.power_m2 += sum / points / count;
    square += std::pow(sum / points, 2) / count;
  }
  if (out.power_m2 > 0.0 && count > 1.0) {
    out.spread = std::sqrt(std::max(0.0, square / (out.power_m2 * out.power_m2) - 1.0) * count / (count - 1.0));
  }
  return out;
}

std::vector<char> without_noisiest(const std::vector<Block>& blocks, const std::vector<double>& noise_m2) {
  std::vector<double> sorted = noise_m2;
  std::sort(sorted.begin(), sorted.end());
  const double most_m2 = sorted[static_cast<std::size_t>(kTypical * static_cast<double>(sorted.size() - 1))];
  std::vector<char> out(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) out[b] = noise_m2[b] <= most_m2 ? 1 : 0;
  return out;
}

double mean_over(const std::vector<Block>& blocks, const std::vector<char>& takes, const std::vector<double>& value) {
  double sum = 0.0, points = 0.0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (takes[b] == 0) continue;
    sum += blocks[b].points * value[b];
    points += blocks[b].points;
  }
  return points > 0.0 ? sum / points : 0.0;
}

std::vector<double> squares_of(const std::vector<double>& x, const std::vector<Block>& blocks) {
  std::vector<double> out;
  for (const Block& b : blocks) out.push_back(mean_square(std::span(x).subspan(b.first, b.last - b.first)));
  return out;
}

std::vector<std::vector<double>> difference(std::vector<std::vector<double>> a,
                                            const std::vector<std::vector<double>>& b) {
  for (std::size_t j = 0; j < a.size(); ++j) {
    for (std::size_t i = 0; i < a[j].size(); ++i) a[j][i] -= b[j][i];
  }
  return a;
}

}  // namespace asperity
