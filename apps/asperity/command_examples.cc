#include "command_examples.h"

#include <array>
#include <utility>

namespace asperity::app {

namespace {

using Example = std::pair<std::string_view, std::string_view>;

constexpr std::array kExamples{
    Example{"demo", "asperity demo -o out"},
    Example{"demo", "asperity demo --full -o out"},
    Example{"simulate", "asperity simulate --surface sandpaper --speed 25mm/s --seed 1 -o rec"},
    Example{"simulate", "asperity simulate --surface heights.csv --material cork -o rec"},
    Example{"import", "asperity import --pose mocap.csv --imu imu.csv --dry-run"},
    Example{"import", "asperity import --pose mocap.csv --imu imu.csv --clocks separate -o rec"},
    Example{"inspect", "asperity inspect rec"},
    Example{
        "record",
        "asperity record --probe serial:/dev/ttyUSB0 --camera v4l2:/dev/video0 --markers markers.json --calibration "
        "calibration.json -o rec"},
    Example{"recover", "asperity recover rec -o saved"},
    Example{"track", "asperity track images --camera calibration.json --markers markers.json -o tracker.csv"},
    Example{"process", "asperity process rec -o out"},
    Example{"process", "asperity process monday tuesday -o out"},
    Example{"report", "asperity report monday tuesday -o both.html"},
    Example{"plot", "asperity plot out -o out.svg"},
    Example{"roughness", "asperity roughness out"},
    Example{"roughness", "asperity roughness surface.x3p --lambda-s 2.5um --lambda-c 0.8mm --report surface.html"},
    Example{"merge", "asperity merge stroke1 stroke2 stroke3 -o merged"},
    Example{"register", "asperity register rec object.obj --mesh-unit mm -o out"},
    Example{"register", "asperity register rec2 object.obj --mesh-unit mm --into out/scene.json"},
    Example{"area", "asperity area out -o patch"},
    Example{
        "paint",
        "asperity paint object.obj --mesh-unit mm --texture wood.texture.json --through \"0,0,10;20,0,10\" -o painted"},
    Example{"feel", "asperity feel out"},
    Example{"export", "asperity export out --to gltf"},
    Example{"export", "asperity export wood.texture.json --to wav"},
    Example{"realism", "asperity realism wood.texture.json --stroke rec -o score"},
    Example{"batch", "asperity batch plan.toml"},
    Example{"bench", "asperity bench closest-point object.obj --mesh-unit mm"},
    Example{"studio", "asperity studio"},
    Example{"studio", "asperity studio out"},
    Example{"check-rig", "asperity check-rig --artefact -o grating.stl"},
    Example{"check-rig", "asperity check-rig rec --pitch 2mm --depth 0.2mm"},
    Example{"texture fit", "asperity texture fit out/profile.csv -o wood.texture.json"},
    Example{"texture info", "asperity texture info wood.texture.json"},
    Example{"texture synthesize", "asperity texture synthesize wood.texture.json -o wood.csv"},
    Example{"texture swap", "asperity texture swap object.scene.json 0 wood.texture.json -o other.scene.json"},
    Example{"texture compare", "asperity texture compare wood.texture.json out/profile.csv"},
    Example{"study plan", "asperity study plan --share 0.7"},
    Example{"study run", "asperity study run wood.study.json --participant p01 --device haply"},
    Example{"study summarize", "asperity study summarize wood_AB12.study.csv"},
    Example{"study table", "asperity study table wood_p01.study.csv wood_p02.study.csv -o wood.csv"},
    Example{"markers sheet", "asperity markers sheet -o tags.pdf"},
    Example{"markers ring", "asperity markers ring -o ring.pdf"},
    Example{"markers board", "asperity markers board -o board.pdf"},
    Example{"markers charuco", "asperity markers charuco -o charuco.pdf"},
    Example{"markers detect", "asperity markers detect image.png"},
    Example{"calibrate camera", "asperity calibrate camera images --board 9x6 --square 25mm -o calibration.json"},
    Example{"calibrate tracker", "asperity calibrate tracker rest -o calibration.json"},
    Example{"calibrate force", "asperity calibrate force weights.csv -o calibration.json"},
    Example{"calibrate accel", "asperity calibrate accel six_sides.csv -o calibration.json"},
    Example{"calibrate tip", "asperity calibrate tip pivot -o calibration.json"},
    Example{"calibrate imu", "asperity calibrate imu waved -o calibration.json"},
    Example{"calibrate latency", "asperity calibrate latency shaken -o calibration.json"},
};

}  // namespace

std::vector<std::string> command_examples(std::string_view command) {
  std::vector<std::string> out;
  for (const auto& [name, line] : kExamples)
    if (name == command) out.emplace_back(line);
  return out;
}

}  // namespace asperity::app
