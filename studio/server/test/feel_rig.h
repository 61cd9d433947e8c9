#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "feel/feel_page.h"
#include "page_rig.h"
#include "read_block.h"

namespace asperity::studio {

// Four grey ramps and waves of 32 × 32 pixels, as a viewer's tiles.
inline void write_height_maps(const std::filesystem::path& folder) {
  for (int k = 0; k < 4; ++k) {
    std::ofstream out(folder / ("tile" + std::to_string(k) + ".pgm"), std::ios::binary);
    out << "P5\n32 32\n255\n";
    for (int row = 0; row < 32; ++row) {
      for (int column = 0; column < 32; ++column) {
        const double wave = std::sin(0.3 * (k + 1) * column) * std::cos(0.2 * row);
        out.put(static_cast<char>(static_cast<unsigned char>(40.0 + 15.0 * wave)));
      }
    }
  }
}

// A square of 20 mm in metres, facing up, without textures.
inline void write_plate(const std::filesystem::path& file) {
  std::ofstream(file) << "v 0 0 0\nv 0.02 0 0\nv 0.02 0.02 0\nv 0 0.02 0\nf 1 2 3\nf 1 3 4\n";
}

// Down onto the first tile within 0.2 s, and 2 mm over it within another 0.2 s.
inline void write_path(const std::filesystem::path& file) {
  std::ofstream out(file);
  out << "t_ns,px_m,py_m,pz_m\n";
  for (int k = 0; k < 400; ++k) {
    out << k * 1'000'000 << ',' << 0.004 + 1e-5 * k << ",0.017," << (k < 200 ? 1e-3 - 1e-5 * k : -1e-3) << '\n';
  }
}

// Keeps every tick of a run as the page would see it.
class FeelHub : public FakeHub {
 public:
  struct Tick {
    double t_s = 0.0;
    double rendered_N = 0.0, out_N = 0.0;  // along the normal, and what was let through
  };

  void publish(std::string_view topic, std::string frame, Delivery) override {
    const std::lock_guard lock(mutex_);
    ++frames_[std::string(topic)];
    const ReadBlock block(std::move(frame));
    if (topic == "feel.state") state_ = block.head;
    if (topic == "feel.sound") sound_ += block.array<float>("force_N").size();
    if (topic != "feel.ticks") return;
    const auto t_s = block.array<double>("t_s");
    const auto contact = block.array<float>("contact_N"), texture = block.array<float>("texture_N"),
               out = block.array<float>("out_N");
    for (std::size_t k = 0; k < t_s.size(); ++k) {
      ticks_.push_back({t_s[k], static_cast<double>(contact[k]) + static_cast<double>(texture[k]), out[k]});
    }
  }
  std::vector<Tick> ticks() const {
    const std::lock_guard lock(mutex_);
    return ticks_;
  }
  Tick newest() const {
    const std::lock_guard lock(mutex_);
    return ticks_.empty() ? Tick{} : ticks_.back();
  }
  std::size_t frames_of(const std::string& topic) const {
    const std::lock_guard lock(mutex_);
    const auto found = frames_.find(topic);
    return found == frames_.end() ? 0 : found->second;
  }
  std::size_t sound() const {
    const std::lock_guard lock(mutex_);
    return sound_;
  }
  Json state() const {
    const std::lock_guard lock(mutex_);
    return state_;
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::size_t> frames_;
  std::vector<Tick> ticks_;
  std::size_t sound_ = 0;
  Json state_;
};

class FeelRig : public PageRig<FeelHub> {
 public:
  static constexpr ClientId kOwner = kClient;

  explicit FeelRig(bool may_command_forces = true, const FeelConfig& start = config()) {
    write_height_maps(folder.path());
    write_plate(folder / "plate.obj");
    shared.may_command_forces = may_command_forces;
    open(std::make_unique<FeelPage>(shared, start));
  }

  // What a loaded machine may take; the servo's own clock is not asked for anything here.
  static FeelConfig config() {
    FeelConfig out;
    out.feel.servo.safety.stale_after_s = 1.0;
    out.feel.servo.safety.soft_start_s = 0.02;
    out.feel.servo.priority = RealTimePriority::kIgnore;
    out.pointer.stalled_after_s = 2.0;
    return out;
  }

  Json status() { return call("feel.status").result; }

  void choose_height_maps() {
    document.edit("/feel/height_maps", {"tile0.pgm", "tile1.pgm", "tile2.pgm", "tile3.pgm"}, "choose");
    EXPECT_TRUE(wait([&] { return !status()["revision"].is_null() && !status()["loading"].get<bool>(); }));
  }
  void own_force() {
    EXPECT_TRUE(lease.acquire(kOwner, host_now_ns()));
    beating = {kOwner};
  }
  // Presses into the first tile; returns when the hand would feel it.
  void touch() {
    pointer_m = {0.007, 0.017, 0.004};
    pointing = true;
    const std::size_t before = hub.ticks().size();
    EXPECT_TRUE(wait([&] { return hub.ticks().size() > before + 300; }));
    pointer_m.z() = -0.004;
    EXPECT_TRUE(wait([&] { return hub.newest().out_N > 0.3; }));
  }

  std::vector<ClientId> beating;
  bool pointing = false;
  Eigen::Vector3d pointer_m = Eigen::Vector3d::Zero();

 private:
  void turned() override {
    for (const ClientId client : beating) lease.acquire(client, host_now_ns());  // also after a machine's long sleep
    if (pointing) page->pointed(kOwner, Pointer{0, {pointer_m.x(), pointer_m.y(), pointer_m.z()}});
  }
};

}  // namespace asperity::studio
