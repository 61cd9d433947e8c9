#include "fourier_transform.h"

#include <algorithm>
#include <cmath>
#include <list>
#include <numbers>

#include "asperity/signal/spectrum.h"
#include "fourier_pass.h"

namespace asperity {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

constexpr std::size_t kMostKept = std::size_t{1} << 20;  // numbers in the tables that a thread keeps

// Complex numbers as two rows, so that neighbours are in one register.
struct Rows {
  std::vector<double> re, im;
  explicit Rows(std::size_t n) : re(n), im(n) {}
};

// exp(−2πi k/n)
Rows unit_roots(std::size_t n) {
  Rows out(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = -2.0 * pi * static_cast<double>(k) / static_cast<double>(n);
    out.re[k] = std::cos(angle);
    out.im[k] = std::sin(angle);
  }
  return out;
}

// The tables of one length: roots of `step` times as fine a division as the length needs.
class Plan {
 public:
  // `step` is 2 for the half of an even real transform.
  Plan(std::size_t n, std::size_t step) : n_(n), step_(step), root_(unit_roots(n * step)), x_(n), y_(n) {
    std::size_t left = n, stride = 1;
    const auto divide = [&](std::size_t radix) {
      for (; left % radix == 0; left /= radix, stride *= radix) passes_.push_back({radix, left, stride});
    };
    for (const std::size_t radix : {4, 2, 3, 5}) divide(radix);
    smooth_ = left == 1;
  }

  bool smooth() const { return smooth_; }
  std::size_t length() const { return n_; }
  std::size_t step() const { return step_; }
  std::size_t kept() const { return n_ * step_ + 2 * n_; }
  Complex root(std::size_t k) const { return {root_.re[k], root_.im[k]}; }
  Rows& x() { return x_; }

  // The transform of x(), in x().
  void run() {
    for (const Pass& pass : passes_) {
      const Roots root{root_.re.data(), root_.im.data(), pass.stride * step_};
      const View from{x_.re.data(), x_.im.data()}, to{y_.re.data(), y_.im.data()};
      run_pass(pass, root, from, to);
      std::swap(x_, y_);
    }
  }

 private:
  std::size_t n_, step_;
  Rows root_;
  Rows x_, y_;
  std::vector<Pass> passes_;
  bool smooth_ = false;
};

// Bluestein's: k m = (k² + m² − (k − m)²)/2, so that the transform is a convolution with the chirp exp(πi k²/n), here
// of a length that is smooth.
struct Chirp {
  std::size_t n = 0;
  std::vector<Complex> chirp;     // exp(−πi k²/n)
  std::vector<Complex> spectrum;  // of its conjugate, wrapped
  std::size_t kept() const { return n + spectrum.size(); }
};

// What a thread has used last, newest first.
struct Kept {
  std::list<Plan> plans;
  std::list<Chirp> chirps;
};
thread_local Kept kept;

// Of all that a thread keeps, what it used last.
template <class Entry>
void forget_oldest(std::list<Entry>& entries) {
  std::size_t total = 0;
  auto last = entries.begin();
  for (; last != entries.end(); ++last) {
    total += last->kept();
    if (total > kMostKept) break;
  }
  entries.erase(last, entries.end());
}

// Its end is that of a call, and of the references that the call took.
struct Call {
  Call() = default;
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;
  ~Call() {
    forget_oldest(kept.plans);
    forget_oldest(kept.chirps);
  }
};

template <class Entry, class Is, class Make>
Entry& find_or_make(std::list<Entry>& entries, const Is& is, const Make& make) {
  const auto found = std::find_if(entries.begin(), entries.end(), is);
  if (found != entries.end()) {
    entries.splice(entries.begin(), entries, found);
  } else {
    entries.push_front(make());
  }
  return entries.front();
}

Plan& plan_of(std::size_t n, std::size_t step) {
  return find_or_make(
      kept.plans, [&](const Plan& plan) { return plan.length() == n && plan.step() == step; },
      [&] { return Plan(n, step); });
}

void transform_smooth(std::vector<Complex>& x) {
  Plan& plan = plan_of(x.size(), 1);
  for (std::size_t k = 0; k < x.size(); ++k) {
    plan.x().re[k] = x[k].real();
    plan.x().im[k] = x[k].imag();
  }
  plan.run();
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = {plan.x().re[k], plan.x().im[k]};
}

Chirp make_chirp(std::size_t n) {
  Chirp out{n, std::vector<Complex>(n), std::vector<Complex>(smooth_length(2 * n - 1))};
  for (std::size_t k = 0; k < n; ++k) {
    // k² modulo 2n first: the angle of a large square has no digits left.
    out.chirp[k] = std::polar(1.0, -pi * static_cast<double>((k * k) % (2 * n)) / static_cast<double>(n));
    out.spectrum[k] = std::conj(out.chirp[k]);
    if (k > 0) out.spectrum[out.spectrum.size() - k] = out.spectrum[k];
  }
  transform_smooth(out.spectrum);
  return out;
}

std::vector<Complex> chirp_dft(std::span<const Complex> x) {
  const std::size_t n = x.size();
  const Chirp& chirp = find_or_make(
      kept.chirps, [&](const Chirp& one) { return one.n == n; }, [&] { return make_chirp(n); });
  const std::size_t m = chirp.spectrum.size();
  std::vector<Complex> a(m);
  const auto times = [](Complex p, Complex q) {  // without the standard's care for infinities
    return Complex(p.real() * q.real() - p.imag() * q.imag(), p.real() * q.imag() + p.imag() * q.real());
  };
  for (std::size_t k = 0; k < n; ++k) a[k] = times(x[k], chirp.chirp[k]);
  transform_smooth(a);
  // The inverse is the conjugate of the transform of the conjugate.
  for (std::size_t k = 0; k < m; ++k) a[k] = std::conj(times(a[k], chirp.spectrum[k]));
  transform_smooth(a);
  std::vector<Complex> out(n);
  for (std::size_t k = 0; k < n; ++k) out[k] = times(std::conj(a[k]), chirp.chirp[k]) / static_cast<double>(m);
  return out;
}

// Transforms the plan's numbers, which the caller has put into plan.x(), by whatever way their length asks for.
void run(Plan& plan) {
  if (plan.smooth()) return plan.run();
  std::vector<Complex> x(plan.length());
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = {plan.x().re[k], plan.x().im[k]};
  const std::vector<Complex> out = chirp_dft(x);
  for (std::size_t k = 0; k < x.size(); ++k) {
    plan.x().re[k] = out[k].real();
    plan.x().im[k] = out[k].imag();
  }
}

}  // namespace

std::size_t smooth_length(std::size_t n) {
  std::size_t best = 1;
  while (best < n) best *= 2;
  for (std::size_t five = 1; five < best; five *= 5) {
    for (std::size_t three = five; three < best; three *= 3) {
      std::size_t two = three;
      while (two < n) two *= 2;
      best = std::min(best, two);
    }
  }
  return best;
}

std::vector<Complex> complex_dft(std::span<const Complex> x) {
  const Call call;
  std::vector<Complex> out(x.begin(), x.end());
  if (x.size() < 2) return out;
  if (smooth_length(x.size()) != x.size()) return chirp_dft(x);
  transform_smooth(out);
  return out;
}

std::vector<Complex> even_real_dft(std::span<const double> x) {
  const Call call;
  const std::size_t half = x.size() / 2;
  Plan& plan = plan_of(half, 2);
  for (std::size_t i = 0; i < half; ++i) {
    plan.x().re[i] = x[2 * i];
    plan.x().im[i] = x[2 * i + 1];
  }
  run(plan);
  const double* re = plan.x().re.data();
  const double* im = plan.x().im.data();
  std::vector<Complex> out(half + 1);
  out[0] = {re[0] + im[0], 0.0};
  out[half] = {re[0] - im[0], 0.0};
  for (std::size_t k = 1; k < half; ++k) {
    const std::size_t mirror = half - k;
    const double even_re = 0.5 * (re[k] + re[mirror]), even_im = 0.5 * (im[k] - im[mirror]);
    const double odd_re = 0.5 * (im[k] + im[mirror]), odd_im = 0.5 * (re[mirror] - re[k]);
    const Complex w = plan.root(k);
    out[k] = {even_re + w.real() * odd_re - w.imag() * odd_im, even_im + w.real() * odd_im + w.imag() * odd_re};
  }
  return out;
}

std::vector<double> even_inverse_real_dft(std::span<const Complex> spectrum) {
  const Call call;
  const std::size_t half = spectrum.size() - 1;
  Plan& plan = plan_of(half, 2);
  // Z_k = E_k + iO_k, conjugated: the inverse is the conjugate of the transform of the conjugate.
  plan.x().re[0] = 0.5 * (spectrum[0].real() + spectrum[half].real());
  plan.x().im[0] = -0.5 * (spectrum[0].real() - spectrum[half].real());
  for (std::size_t k = 1; k < half; ++k) {
    const Complex here = spectrum[k], mirror = spectrum[half - k], w = plan.root(k);
    const double even_re = 0.5 * (here.real() + mirror.real()), even_im = 0.5 * (here.imag() - mirror.imag());
    const double dre = 0.5 * (here.real() - mirror.real()), dim = 0.5 * (here.imag() + mirror.imag());
    const double odd_re = dre * w.real() + dim * w.imag(), odd_im = dim * w.real() - dre * w.imag();
    plan.x().re[k] = even_re - odd_im;
    plan.x().im[k] = -(even_im + odd_re);
  }
  run(plan);
  const double scale = 1.0 / static_cast<double>(half);
  std::vector<double> x(2 * half);
  for (std::size_t i = 0; i < half; ++i) {
    x[2 * i] = plan.x().re[i] * scale;
    x[2 * i + 1] = -plan.x().im[i] * scale;
  }
  return x;
}

}  // namespace asperity
