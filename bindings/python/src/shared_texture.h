#pragma once

#include <memory>
#include <utility>

#include <pybind11/pybind11.h>

#include "asperity/texture/texture.h"

namespace asperity::python {

// A texture of Python: its own, or that of a result or scene, which cannot be changed. Who reads it without Python's
// lock keeps share(); a change meanwhile is made to a copy.
class SharedTexture {
 public:
  explicit SharedTexture(Texture own) : texture_(std::make_shared<Texture>(std::move(own))) {}
  // Of a result or scene: `owner` says whose.
  SharedTexture(std::shared_ptr<const Texture> of, const char* owner)
      : texture_(std::const_pointer_cast<Texture>(std::move(of))), owner_(owner) {}

  const Texture& get() const { return *texture_; }
  std::shared_ptr<const Texture> share() const { return texture_; }

  // Throws AttributeError for that of a result or scene.
  Texture& change() {
    if (owner_ != nullptr) {
      throw pybind11::attribute_error("the texture of a " + std::string(owner_) +
                                      " cannot be changed; change a copy of it: copy()");
    }
    if (texture_.use_count() > 1) texture_ = std::make_shared<Texture>(*texture_);
    return *texture_;
  }

 private:
  std::shared_ptr<Texture> texture_;  // with an owner: never changed
  const char* owner_ = nullptr;
};

}  // namespace asperity::python
