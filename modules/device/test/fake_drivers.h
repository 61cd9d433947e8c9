#pragma once

#include <dlfcn.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

#include <Eigen/Core>

#include "asperity/testkit/temp_dir.h"

namespace asperity::testing_devices {

// The controls that a fake driver exports beside the vendor's functions. Puts the fake into its first state.
class FakeDriver {
 public:
  FakeDriver(const char* library, const std::string& prefix)
      : handle_(dlopen(library, RTLD_NOW | RTLD_LOCAL)), prefix_(prefix) {
    if (handle_ == nullptr) throw std::runtime_error(dlerror());
    function<void()>("reset")();
  }
  ~FakeDriver() { dlclose(handle_); }
  FakeDriver(const FakeDriver&) = delete;
  FakeDriver& operator=(const FakeDriver&) = delete;

  template <class Signature>
  Signature* function(const std::string& name) const {
    void* const address = dlsym(handle_, (prefix_ + name).c_str());
    if (address == nullptr) throw std::runtime_error("no " + prefix_ + name);
    return reinterpret_cast<Signature*>(address);
  }

  void set(const char* what, int value) { function<void(const char*, int)>("set")(what, value); }
  bool open() const { return function<int()>("open")() != 0; }
  Eigen::Vector3d motor_N() const {
    Eigen::Vector3d out_N;
    function<void(double*)>("motor")(out_N.data());
    return out_N;
  }

 private:
  void* handle_;
  std::string prefix_;
};

// OpenHaptics' fake, which is loaded by a process of its own: its state is in a file that both have mapped, one of this
// program.
class FakeOpenHaptics : public FakeDriver {
 public:
  explicit FakeOpenHaptics(const char* library) : FakeDriver((share(), library), "fake_hd_") {}

  pid_t process() const { return function<int()>("process")(); }

 private:
  static void share() {
    static const testkit::TempDir dir;
    const std::string path = (dir.path() / "hd_state").string();
    if (::setenv("FAKE_HD_STATE", path.c_str(), 0) == 0) std::ofstream(path, std::ios::app);
  }
};

}  // namespace asperity::testing_devices
