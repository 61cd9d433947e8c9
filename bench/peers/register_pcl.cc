#include <cmath>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/icp.h>
#include <pcl/search/kdtree.h>
#include <Eigen/Geometry>

#include "register_peer.h"

namespace asperity {

// PCL knows points, not triangles: the mesh's vertices with their normals, the tree over them built once. Lengths in
// millimetres, because PCL computes in float.
struct PeerRegistration::Library {
  using Point = pcl::PointNormal;
  pcl::PointCloud<Point>::Ptr target{new pcl::PointCloud<Point>};
  pcl::search::KdTree<Point>::Ptr tree{new pcl::search::KdTree<Point>};
};

namespace {

pcl::PointNormal to_point(const Eigen::Vector3d& p_m, const Eigen::Vector3d& n) {
  pcl::PointNormal out;
  out.getVector3fMap() = (1e3 * p_m).cast<float>();
  out.getNormalVector3fMap() = n.cast<float>();
  return out;
}

}  // namespace

PeerRegistration::PeerRegistration(const TriangleMesh& mesh) : library_(new Library) {
  std::vector<Eigen::Vector3d> normals(mesh.vertices_m.size(), Eigen::Vector3d::Zero());
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices_m[t[0]];
    const Eigen::Vector3d n = (mesh.vertices_m[t[1]] - a).cross(mesh.vertices_m[t[2]] - a);
    for (const auto i : t) normals[i] += n;
  }
  for (std::size_t i = 0; i < normals.size(); ++i) {
    library_->target->push_back(to_point(mesh.vertices_m[i], normals[i].normalized()));
  }
  library_->tree->setInputCloud(library_->target);
}

PeerRegistration::~PeerRegistration() = default;
const char* PeerRegistration::name() const { return "PCL, point to plane"; }

Pose PeerRegistration::align(const std::vector<Eigen::Vector3d>& p_world_m, const Pose& guess) {
  pcl::PointCloud<Library::Point>::Ptr source(new pcl::PointCloud<Library::Point>);
  for (const Eigen::Vector3d& p : p_world_m) source->push_back(to_point(guess * p, Eigen::Vector3d::UnitZ()));
  pcl::IterativeClosestPointWithNormals<Library::Point, Library::Point> icp;
  icp.setInputSource(source);
  icp.setSearchMethodTarget(library_->tree, true);
  icp.setInputTarget(library_->target);
  icp.setMaximumIterations(30);
  icp.setTransformationEpsilon(1e-8);
  pcl::PointCloud<Library::Point> moved;
  icp.align(moved);
  const Eigen::Matrix4d found = icp.getFinalTransformation().cast<double>();
  const Eigen::Quaterniond turn = Eigen::Quaterniond(Eigen::Matrix3d(found.topLeftCorner<3, 3>())).normalized();
  return Pose{turn, 1e-3 * found.topRightCorner<3, 1>()} * guess;
}

}  // namespace asperity
