#pragma once

#include "asperity/render/proxy_state.h"
#include "asperity/render/texture_state.h"

namespace asperity {

// All that one tip remembers between two servo steps. Plain data; begin with ServoState{}.
struct ServoState {
  ProxyState proxy;
  TextureState texture;
};

}  // namespace asperity
