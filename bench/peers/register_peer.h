#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// Another library's registration of points on a mesh, prepared once: PCL's, or none where it is not installed.
class PeerRegistration {
 public:
  explicit PeerRegistration(const TriangleMesh& mesh);
  ~PeerRegistration();
  PeerRegistration(const PeerRegistration&) = delete;
  PeerRegistration& operator=(const PeerRegistration&) = delete;

  const char* name() const;  // null without a library
  Pose align(const std::vector<Eigen::Vector3d>& p_world_m, const Pose& guess);

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace asperity
