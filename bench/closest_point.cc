// Closest points on one mesh, ours beside those of Embree and CGAL where they are installed, in one run:
// closest_point [mesh file [subdivisions]]. Without a mesh a bumpy torus of 93,636 triangles.
#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/read_mesh.h"
#include "peers/closest_peer.h"
#include "query_patterns.h"

namespace {

using asperity::MeshBvh;
using asperity::TriangleMesh;
using Eigen::Vector3d;

class OurPeer final : public bench::ClosestPeer {
 public:
  explicit OurPeer(const TriangleMesh& mesh) : bvh_(mesh) {}
  const char* name() const override { return "Asperity"; }
  void distances(std::span<const Vector3d> points_m, bool warm, std::span<double> out_m) const override {
    asperity::ClosestPoint nearest;
    for (std::size_t i = 0; i < points_m.size(); ++i) {
      nearest = warm ? bvh_.closest_point(points_m[i], nearest) : bvh_.closest_point(points_m[i]);
      out_m[i] = nearest.distance_m;
    }
  }
  std::size_t memory_bytes() const override { return bvh_.memory_bytes(); }

 private:
  MeshBvh bvh_;
};

double cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::size_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

void time_build() {
  const TriangleMesh mesh = bench::bumpy_torus(1000, 500);
  const std::size_t before = peak_bytes();
  std::vector<double> seconds;
  std::size_t bytes = 0, peak = 0;
  for (int repetition = 0; repetition < 5; ++repetition) {
    const double start = cpu_s();
    const MeshBvh bvh(mesh);
    seconds.push_back(cpu_s() - start);
    bytes = bvh.memory_bytes();
    peak = peak_bytes() - before;
  }
  std::printf("build of %zu triangles: %.3f s, %.1f MB kept, peak %.0f MB more\n", mesh.triangles.size(),
              median(seconds), 1e-6 * static_cast<double>(bytes), 1e-6 * static_cast<double>(peak));
}

void time_queries(const TriangleMesh& mesh) {
  constexpr std::size_t kQueries = 20000;
  constexpr int kRepetitions = 15;
  const auto patterns = bench::make_query_patterns(mesh, kQueries, 1);
  const struct {
    const char* name;
    const std::vector<Vector3d>& points;
    bool warm;
  } kinds[] = {{"near", patterns.near, false},
               {"random", patterns.random, false},
               {"coherent", patterns.path, false},
               {"warm", patterns.path, true}};

  std::vector<std::unique_ptr<bench::ClosestPeer>> peers;
  peers.push_back(std::make_unique<OurPeer>(mesh));
#ifdef ASPERITY_HAVE_EMBREE
  peers.push_back(bench::make_embree_peer(mesh));
#else
  std::printf("Embree: not installed (libembree-dev), skipped\n");
#endif
#ifdef ASPERITY_HAVE_CGAL
  peers.push_back(bench::make_cgal_peer(mesh));
#else
  std::printf("CGAL: not installed (libcgal-dev), skipped\n");
#endif

  std::printf("%zu triangles, %.1f MB; ns a query, median of %d interleaved runs of %zu; in brackets ours / theirs\n",
              mesh.triangles.size(), 1e-6 * static_cast<double>(peers.front()->memory_bytes()), kRepetitions, kQueries);
  std::printf("%-10s", "");
  for (const auto& peer : peers) std::printf("%18s", peer->name());
  std::printf("   largest difference of a distance, m\n");
  for (const auto& kind : kinds) {
    std::vector<std::vector<double>> ns(peers.size()), out(peers.size(), std::vector<double>(kQueries));
    for (int repetition = 0; repetition < kRepetitions; ++repetition)
      for (std::size_t i = 0; i < peers.size(); ++i) {
        const double start = cpu_s();
        peers[i]->distances(kind.points, kind.warm, out[i]);
        ns[i].push_back(1e9 * (cpu_s() - start) / kQueries);
      }
    std::printf("%-10s", kind.name);
    double difference = 0.0;
    for (std::size_t i = 0; i < peers.size(); ++i) {
      if (i == 0)
        std::printf("%18.0f", median(ns[i]));
      else
        std::printf("%11.0f (%.2f)", median(ns[i]), median(ns[0]) / median(ns[i]));
      for (std::size_t k = 0; k < kQueries; ++k) difference = std::max(difference, std::abs(out[i][k] - out[0][k]));
    }
    std::printf("   %.1e\n", difference);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    constexpr double kSize_m = 0.12;
    TriangleMesh mesh = argc > 1 ? bench::scaled_to(asperity::to_metres(asperity::read_mesh(argv[1]), 1.0), kSize_m)
                                 : bench::bumpy_torus(306, 153);
    for (int i = argc > 2 ? std::atoi(argv[2]) : 0; i > 0; --i) mesh = bench::subdivide(mesh);
    time_build();
    time_queries(mesh);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "closest_point: %s\n", error.what());
    return 1;
  }
  return 0;
}
