#include "home/sample_project.h"

#include <array>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/recording/write_recording.h"
#include "asperity/simulation/simulate_recording.h"
#include "asperity/web/assets.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 3> kSurfaces{"protoboard", "sandpaper", "cable_tie"};
constexpr double kSpeed_mps = 0.025;
constexpr double kLength_m = 0.08;

constexpr const char* kReadme = R"(The sample project of Asperity

protoboard, sandpaper, cable_tie   simulated scans (recordings), 80 mm each at 25 mm/s, with the true surface
results/NAME                       what "asperity process" makes of them: profile, roughness and texture
stylus/profile.csv                 a real surface: heights in micrometres by a stylus instrument, 0.5 um apart
stylus/LICENSE                     whose data that is (MIT licence)

Things to try in the studio
  Process   choose protoboard, then sandpaper: profile, spectrum and roughness, with the truth in comparison
  Add files choose Heights of stylus/profile.csv, and 0.0005 mm as the spacing: roughness as in ISO 21920-2
  Feel      choose a texture of results/ and touch it with the mouse

The same in a terminal
  asperity process protoboard -o out
  asperity roughness stylus/profile.csv --spacing 0.5um --class auto
)";

void write_asset(const char* path, const fs::path& file) {
  const auto asset = web::find_asset(path);
  if (!asset || asset->compressed) throw Error(std::string(path) + ": is not in this program");
  write_file(file, asset->content);
}

}  // namespace

void write_sample_project(const fs::path& folder, const Observer& observer) {
  fs::create_directories(folder / "stylus");
  write_asset("/sample/profile.csv", folder / "stylus" / "profile.csv");
  write_asset("/sample/LICENSE.txt", folder / "stylus" / "LICENSE");
  write_file(folder / "README.txt", kReadme);
  double done = 0.0;
  for (const char* surface : kSurfaces) {
    observer.update(surface, done / static_cast<double>(kSurfaces.size()));
    SimulationConfig config = make_simulation_config(surface, "open");
    config.hand.speed_mps = kSpeed_mps;
    config.hand.length_m = kLength_m;
    const Recording recording = simulate_recording(config);
    const fs::path recorded = folder / surface, result = folder / "results" / surface;
    fs::create_directories(recorded);
    fs::create_directories(result);
    write_recording(recorded, recording);
    write_result(result, process_recording(recording, ProcessConfig()), recording, surface);
    done += 1.0;
  }
  observer.update("done", 1.0);
}

}  // namespace asperity::studio
