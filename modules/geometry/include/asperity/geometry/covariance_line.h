#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// A covariance a sample: each held, or linear between nodes that are fewer than the samples, which takes a sixth of the
// memory.
class CovarianceLine {
 public:
  CovarianceLine() = default;
  CovarianceLine(std::initializer_list<Eigen::Matrix3d> each) : nodes_(each) {}
  // No samples yet: they come by push_between(), about `samples` of them.
  static CovarianceLine between(std::vector<Eigen::Matrix3d> nodes, std::size_t samples);

  std::size_t size() const { return is_between_ ? node_.size() : nodes_.size(); }
  bool empty() const { return size() == 0; }
  Eigen::Matrix3d operator[](std::size_t i) const {
    if (!is_between_) return nodes_[i];
    const std::size_t node = node_[i];
    if (node + 1 == nodes_.size()) return nodes_[node];
    return (1.0 - share_[i]) * nodes_[node] + share_[i] * nodes_[node + 1];
  }
  Eigen::Matrix3d at(std::size_t i) const;  // throws std::out_of_range
  Eigen::Matrix3d back() const { return (*this)[size() - 1]; }

  // The next sample, `share` in [0, 1] of the way from one node to the next; at the last node there is none.
  void push_between(std::size_t node, double share) {
    node_.push_back(static_cast<std::uint32_t>(node));
    share_.push_back(share);
  }

  // From here on each is held.
  void push_back(const Eigen::Matrix3d& covariance);
  void set(std::size_t i, const Eigen::Matrix3d& covariance);
  void append(const CovarianceLine& from);
  void assign(std::size_t count, const Eigen::Matrix3d& covariance);
  void reserve(std::size_t count) { nodes_.reserve(count); }
  void clear() { *this = {}; }

  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Eigen::Matrix3d;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = Eigen::Matrix3d;

    Iterator(const CovarianceLine& line, std::size_t i) : line_(&line), i_(i) {}
    Eigen::Matrix3d operator*() const { return (*line_)[i_]; }
    Iterator& operator++() {
      ++i_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return i_ == other.i_; }

   private:
    const CovarianceLine* line_;
    std::size_t i_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  void hold_each();

  bool is_between_ = false;
  std::vector<Eigen::Matrix3d> nodes_;  // or one a sample
  std::vector<std::uint32_t> node_;     // the node before the sample
  std::vector<double> share_;
};

}  // namespace asperity
