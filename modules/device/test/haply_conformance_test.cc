#include "asperity/device/open_haply.h"
#include "conformance.h"
#include "fake_inverse_service.h"

namespace asperity::testing_devices {

namespace {

class HaplyRig final : public DeviceRig {
 public:
  explicit HaplyRig(const std::string& version) : service_(config_for(version)) {}

  std::unique_ptr<HapticDevice> open() override {
    HaplyConfig config;
    config.host = "127.0.0.1";
    config.port = service_.port();
    return open_haply(config);
  }
  Eigen::Vector3d motor_output() override {
    const Eigen::Vector3d force_N = service_.applied_N();
    return {force_N.x(), force_N.z(), -force_N.y()};
  }
  bool exclusive() const override { return false; }  // the service serves several sessions
  void unplug() override { service_.unplug(); }
  void stall() override { service_.stall(true); }

 private:
  static FakeInverseConfig config_for(const std::string& version) {
    FakeInverseConfig config;
    config.version = version;
    config.pull_N = {0.0, 0.0, -kPull_N};
    return config;
  }
  FakeInverseService service_;
};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Haply, DeviceConformance,
                         testing::Values(ConformanceCase{"haply31", [] { return std::make_unique<HaplyRig>("3.1.1"); }},
                                         ConformanceCase{"haply35",
                                                         [] { return std::make_unique<HaplyRig>("3.5.0"); }}),
                         case_name);

}  // namespace asperity::testing_devices
