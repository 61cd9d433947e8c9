#include "asperity/simulation/contact_config.h"

namespace asperity {

SimulatedContactConfig make_contact(ContactMaterial material) {
  SimulatedContactConfig contact;
  switch (material) {
    case ContactMaterial::kStiff:
      break;
    case ContactMaterial::kCork:
      contact.stiffness_N_per_m = 1.0e4;
      contact.damping_ratio = 0.4;
      contact.friction_static = 0.45;
      contact.friction_dynamic = 0.38;
      break;
    case ContactMaterial::kSoftRubber:
      contact.stiffness_N_per_m = 2.0e3;
      contact.damping_ratio = 0.5;
      contact.friction_static = 0.9;
      contact.friction_dynamic = 0.75;
      contact.friction_bristle_per_m = 1.0e4;
      break;
  }
  return contact;
}

}  // namespace asperity
