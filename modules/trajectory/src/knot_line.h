#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace asperity::inertial_smoother {

// One instant: a probe sample or the time of a tracker pose. Inputs hold there and are linear between.
// Densities are of the segment that begins here, before the components' factors.
struct Knot {
  double t = 0.0;  // s
  Eigen::Vector3d f = Eigen::Vector3d::Zero();
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  std::array<double, 3> accel_psd{};  // own, motion, jitter; (m/s²)²/Hz
  // Of kAccelFast, sensor axes: the elements xx, yy, zz, xy, xz, yz.
  Eigen::Matrix<float, 6, 1> accel_fast = Eigen::Matrix<float, 6, 1>::Zero();
  std::array<double, 2> gyro_psd{};  // own, motion; (rad/s)²/Hz
  std::int64_t sample = -1;
};

// Makes knots that are not held: those of an hour would take gigabytes.
class KnotSource {
 public:
  KnotSource() = default;
  KnotSource(const KnotSource&) = delete;
  KnotSource& operator=(const KnotSource&) = delete;
  virtual ~KnotSource() = default;
  virtual std::size_t size() const = 0;
  virtual Knot knot(std::size_t k) const = 0;
  virtual std::int64_t sample(std::size_t k) const = 0;  // of that knot
};

// Knots in order of time: held, or made by a source each time they are asked for.
class KnotLine {
 public:
  KnotLine() = default;
  explicit KnotLine(std::shared_ptr<const KnotSource> source) : source_(std::move(source)), size_(source_->size()) {}

  std::size_t size() const { return source_ ? size_ : held_.size(); }
  Knot operator[](std::size_t k) const { return source_ ? source_->knot(k) : held_[k]; }
  std::int64_t sample(std::size_t k) const { return source_ ? source_->sample(k) : held_[k].sample; }
  Knot front() const { return (*this)[0]; }
  Knot back() const { return (*this)[size() - 1]; }

  void clear() {
    held_.clear();
    source_.reset();
  }
  // Leaves out the knots from `size`, which is not more than there are, on.
  void shorten(std::size_t size) {
    size_ = size;
    if (!source_) held_.resize(size);
  }
  // Of a line without a source.
  void push_back(const Knot& knot) {
    assert(!source_);
    held_.push_back(knot);
  }
  void append(const KnotLine& from, std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) held_.push_back(from[k]);
  }

 private:
  std::vector<Knot> held_;
  std::shared_ptr<const KnotSource> source_;
  std::size_t size_ = 0;  // with a source
};

}  // namespace asperity::inertial_smoother
