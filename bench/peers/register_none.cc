#include "register_peer.h"

namespace asperity {

struct PeerRegistration::Library {};

PeerRegistration::PeerRegistration(const TriangleMesh&) {}
PeerRegistration::~PeerRegistration() = default;
const char* PeerRegistration::name() const { return nullptr; }
Pose PeerRegistration::align(const std::vector<Eigen::Vector3d>&, const Pose& guess) { return guess; }

}  // namespace asperity
