#include "virtual_gamepad.h"

#include <chrono>
#include <mutex>

#include "../src/sdl_subsystem.h"
#include "asperity/base/error.h"

namespace asperity {

struct VirtualGamepad::Impl {
  SdlSubsystem sdl{SDL_INIT_JOYSTICK};
  std::string name;
  SDL_JoystickID id = -1;
  mutable std::mutex mutex;
  std::vector<Command> commands;
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
};

VirtualGamepad::VirtualGamepad(const std::string& name, bool rumbles) : impl_(std::make_unique<Impl>()) {
  impl_->name = name;
  SDL_VirtualJoystickDesc desc{};
  desc.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
  desc.type = SDL_JOYSTICK_TYPE_GAMECONTROLLER;
  desc.naxes = 2;
  desc.nbuttons = 2;
  desc.name = impl_->name.c_str();
  desc.userdata = impl_.get();
  if (rumbles) {
    desc.Rumble = [](void* self, Uint16 low, Uint16 high) {
      auto& impl = *static_cast<Impl*>(self);
      const std::lock_guard lock(impl.mutex);
      impl.commands.push_back({low / 65535.0, high / 65535.0,
                               std::chrono::duration<double>(std::chrono::steady_clock::now() - impl.begin).count()});
      return 0;
    };
  }
  const int index = SDL_JoystickAttachVirtualEx(&desc);
  if (index < 0) throw Error("virtual gamepad: " + sdl_error());
  impl_->id = SDL_JoystickGetDeviceInstanceID(index);
}

VirtualGamepad::~VirtualGamepad() { unplug(); }

std::vector<VirtualGamepad::Command> VirtualGamepad::commands() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->commands;
}

VirtualGamepad::Command VirtualGamepad::now() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->commands.empty() ? Command{} : impl_->commands.back();
}

void VirtualGamepad::unplug() {
  SDL_LockJoysticks();
  for (int i = 0; i < SDL_NumJoysticks(); ++i) {
    if (SDL_JoystickGetDeviceInstanceID(i) == impl_->id) SDL_JoystickDetachVirtual(i);
  }
  SDL_UnlockJoysticks();
  const std::lock_guard lock(impl_->mutex);
  impl_->commands.push_back({});
}

}  // namespace asperity
