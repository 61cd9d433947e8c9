#include "asperity/profile/causal_base.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr std::int64_t kCell_ns = 5'000'000;  // of the history: what find_base_path looks at
constexpr std::size_t kFewest = 60;           // samples of a fit
constexpr double kShortest_m = 15e-3;  // travel in contact before the first fit: a shorter one is fitted to texture
constexpr std::size_t kMostCells = 12'000;

template <class T>
void drop_front(std::vector<T>& x, std::size_t count) {
  x.erase(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

CausalBase::CausalBase(const CausalBaseConfig& config, const Eigen::Vector3d& tip_in_marker_m)
    : config_(config), tip_in_marker_m_(tip_in_marker_m) {}

void CausalBase::reset() { *this = CausalBase(config_, tip_in_marker_m_); }

Eigen::Vector3d CausalBase::normal_at(const Eigen::Vector3d& p_world_m) const {
  if (shape_ != PathShape::kCircle) return axis_;
  const Eigen::Vector3d d = p_world_m - centre_m_;
  const Eigen::Vector3d across = d - d.dot(axis_) * axis_;
  if (!(across.norm() > 0.0)) return axis_.unitOrthogonal();
  return (outside_ ? 1.0 : -1.0) * std::cos(lean_rad_) * across.normalized() + std::sin(lean_rad_) * axis_;
}

double CausalBase::distance_m(const Eigen::Vector3d& p_world_m) const {
  const Eigen::Vector3d d = p_world_m - centre_m_;
  if (shape_ != PathShape::kCircle) return axis_.dot(d);
  const double r_m = (d - d.dot(axis_) * axis_).norm();
  return std::cos(lean_rad_) * (outside_ ? r_m - radius_m_ : radius_m_ - r_m) + std::sin(lean_rad_) * d.dot(axis_);
}

double CausalBase::height_m(const Eigen::Vector3d& p_world_m) const { return distance_m(p_world_m) + remainder_m_; }

void CausalBase::refit(const Eigen::Vector3d& here_m) {
  const double before_m = height_m(here_m);
  try {
    const BasePathResult base = find_base_path(history_, tip_in_marker_m_, config_.base);
    if (base.normal_sigma_deg > config_.base.probe_axis_sigma_deg) return;  // how the probe is held says more
    if (base.shape == PathShape::kCurve || base.shape == PathShape::kMesh || base.shape == PathShape::kDoublyCurved) {
      // A curve has no closed form here: its tangent plane where the tip is stands in until the next fit.
      shape_ = PathShape::kCurve;
      centre_m_ = base.path.p_world_m.back();
      axis_ = base.path.n_world.back();
    } else {
      shape_ = base.shape;
      centre_m_ = base.centre_world_m;
      axis_ = base.axis_world;
      radius_m_ = base.radius_m;
      lean_rad_ = base.lean_rad;
      outside_ = base.outside;
    }
    normal_sigma_deg_ = base.normal_sigma_deg;
    fitted_ = true;
  } catch (const Error&) {
    return;  // this stretch of the path has no shape: the one before stays
  }
  remainder_m_ = before_m - distance_m(here_m);
}

void CausalBase::push(std::int64_t t_ns, const Eigen::Vector3d& p_world_tip_m, const Eigen::Quaterniond& q_world_marker,
                      double force_N, bool contact, double travelled_m) {
  if (contact && !begun_) {
    begun_ = true;
    centre_m_ = p_world_tip_m;
    const Eigen::Vector3d axis = q_world_marker * Eigen::Vector3d(-tip_in_marker_m_);
    axis_ = axis.norm() > 0.0 ? Eigen::Vector3d(axis.normalized()) : Eigen::Vector3d::UnitZ();
    normal_sigma_deg_ = config_.base.probe_axis_sigma_deg;
    next_fit_ns_ = t_ns + std::llround(config_.period_s * 1e9);
  }
  if (contact) {
    travelled_m_ += std::abs(travelled_m);
    remainder_m_ *= std::exp(-std::abs(travelled_m) / config_.blend_m);
  }
  if (!history_.t_ns.empty() && t_ns < history_.t_ns.back() + kCell_ns) return;
  history_.t_ns.push_back(t_ns);
  history_.p_world_tip_m.push_back(p_world_tip_m);
  history_.q_world_marker.push_back(q_world_marker);
  history_.v_world_tip_mps.push_back(Eigen::Vector3d::Zero());
  history_.a_world_tip_mps2.push_back(Eigen::Vector3d::Zero());
  history_.force_N.push_back(force_N);
  const std::int64_t oldest_ns = t_ns - std::llround(config_.history_s * 1e9);
  auto old = static_cast<std::size_t>(std::lower_bound(history_.t_ns.begin(), history_.t_ns.end(), oldest_ns) -
                                      history_.t_ns.begin());
  if (history_.size() - old > kMostCells) old = history_.size() - kMostCells;
  if (old > history_.size() / 4) {
    drop_front(history_.t_ns, old);
    drop_front(history_.p_world_tip_m, old);
    drop_front(history_.q_world_marker, old);
    drop_front(history_.v_world_tip_mps, old);
    drop_front(history_.a_world_tip_mps2, old);
    drop_front(history_.force_N, old);
  }
  if (!begun_ || t_ns < next_fit_ns_ || history_.size() < kFewest || travelled_m_ < kShortest_m) return;
  next_fit_ns_ = t_ns + std::llround(config_.period_s * 1e9);
  refit(p_world_tip_m);
}

}  // namespace asperity
