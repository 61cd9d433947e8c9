#pragma once

#include <dlfcn.h>

#include <stdexcept>
#include <string>

#include <Eigen/Core>

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

}  // namespace asperity::testing_devices
