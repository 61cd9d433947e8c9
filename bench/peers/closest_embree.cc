// Embree's point query with the triangle test in the user's callback, as Embree asks for, in float.
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "closest_peer.h"

namespace bench {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

// The closest point of a triangle by the region of the plane that p projects into (Ericson 2005, §5.1.5).
Vector3f closest_on_triangle(const Vector3f& p, const Vector3f& a, const Vector3f& b, const Vector3f& c) {
  const Vector3f ab = b - a, ac = c - a, ap = p - a;
  const float d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0f && d2 <= 0.0f) return a;
  const Vector3f bp = p - b;
  const float d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0f && d4 <= d3) return b;
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) return a + d1 / (d1 - d3) * ab;
  const Vector3f cp = p - c;
  const float d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0f && d5 <= d6) return c;
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) return a + d2 / (d2 - d6) * ac;
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0.0f && d4 - d3 >= 0.0f && d5 - d6 >= 0.0f) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const float scale = 1.0f / (va + vb + vc);
  return a + vb * scale * ab + vc * scale * ac;
}

struct Search {
  const Vector3f* vertices;
  const asperity::Triangle* triangles;
  Vector3f nearest;
  std::uint32_t triangle;
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<Search*>(arguments->userPtr);
  const auto& [a, b, c] = search.triangles[arguments->primID];
  const Vector3f p(arguments->query->x, arguments->query->y, arguments->query->z);
  const Vector3f q = closest_on_triangle(p, search.vertices[a], search.vertices[b], search.vertices[c]);
  const float distance = (p - q).norm();
  if (distance > arguments->query->radius) return false;
  arguments->query->radius = distance;
  search.nearest = q;
  search.triangle = arguments->primID;
  return true;
}

class EmbreePeer final : public ClosestPeer {
 public:
  explicit EmbreePeer(const asperity::TriangleMesh& mesh)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    for (const auto& v : mesh.vertices_m) vertices_.push_back(v.cast<float>());
    vertices_.emplace_back(Vector3f::Zero());  // Embree reads 16 bytes of the last vertex
    triangles_ = mesh.triangles;
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices_.data(), 0,
                               sizeof(Vector3f), vertices_.size() - 1);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles_.data(), 0,
                               sizeof(asperity::Triangle), triangles_.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreePeer() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreePeer(const EmbreePeer&) = delete;
  EmbreePeer& operator=(const EmbreePeer&) = delete;

  const char* name() const override { return "Embree"; }

  void distances(std::span<const Vector3d> points_m, bool warm, std::span<double> out_m) const override {
    Search search{vertices_.data(), triangles_.data(), {}, 0};
    for (std::size_t i = 0; i < points_m.size(); ++i) {
      const Vector3f p = points_m[i].cast<float>();
      RTCPointQuery query{};
      query.x = p.x();
      query.y = p.y();
      query.z = p.z();
      query.radius = std::numeric_limits<float>::infinity();
      if (warm && i > 0) {
        const auto& [a, b, c] = triangles_[search.triangle];
        search.nearest = closest_on_triangle(p, vertices_[a], vertices_[b], vertices_[c]);
        query.radius = (p - search.nearest).norm();
      }
      RTCPointQueryContext context;
      rtcInitPointQueryContext(&context);
      rtcPointQuery(scene_, &query, &context, visit, &search);
      out_m[i] = static_cast<double>((p - search.nearest).norm());
    }
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
  std::vector<Vector3f> vertices_;
  std::vector<asperity::Triangle> triangles_;
};

}  // namespace

std::unique_ptr<ClosestPeer> make_embree_peer(const asperity::TriangleMesh& mesh) {
  return std::make_unique<EmbreePeer>(mesh);
}

}  // namespace bench
