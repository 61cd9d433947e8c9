#pragma once

#include <memory>
#include <utility>

#include "asperity/scene/scene.h"

namespace asperity::python {

// A scene of Python. What it holds is never changed, only exchanged for a changed copy: who reads it without Python's
// lock keeps `of`, and what is broken off leaves the scene as it was.
struct SharedScene {
  std::shared_ptr<const Scene> of;

  explicit SharedScene(Scene scene) : of(std::make_shared<const Scene>(std::move(scene))) {}
};

}  // namespace asperity::python
