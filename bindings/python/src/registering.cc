#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "asperity/base/output.h"
#include "asperity/pipeline/write_registration.h"
#include "asperity/session/register_input.h"
#include "inputs.h"
#include "interruptible.h"
#include "parts.h"
#include "shared_scene.h"
#include "unmade.h"
#include "verdicts.h"

namespace asperity::python {

namespace {

// A registration with what it is of: what it writes holds the mesh and the recordings' names.
struct Registration {
  RegisterInput input;
  ScansOnMesh result;

  const RegisteredScan& scan(std::size_t index) const {
    if (index >= result.scans.size()) throw py::index_error("scan: there are " + std::to_string(result.scans.size()));
    return result.scans[index];
  }
};

// x, y, z (m), qw, qx, qy, qz, or a matrix (4, 4).
Pose pose_of(py::handle given) {
  const py::array_t<double> numbers = doubles_of(given, "guess");
  if (numbers.ndim() == 2) return pose_of_matrix(given, "guess");
  if (numbers.ndim() != 1 || numbers.size() != 7)
    throw py::value_error("guess: seven numbers are wanted, x, y, z, qw, qx, qy, qz, or a matrix (4, 4)");
  const double* const seven = numbers.data();
  const Eigen::Quaterniond rotation(seven[3], seven[4], seven[5], seven[6]);
  const Eigen::Vector3d translation_m(seven[0], seven[1], seven[2]);
  if (!translation_m.allFinite() || !rotation.coeffs().allFinite() || !(rotation.norm() > 1e-6))
    throw py::value_error("guess: a pose of finite numbers is wanted, its quaternion not 0");
  return {rotation.normalized(), translation_m};
}

std::shared_ptr<Registration> register_recordings(const std::vector<std::filesystem::path>& scans,
                                                  const std::filesystem::path& mesh, std::optional<double> mesh_unit_m,
                                                  const std::optional<py::object>& guess,
                                                  const std::vector<int>& placements, const Settings& settings) {
  RegisterConfig config;
  set_all(config, settings.of);
  if (scans.empty()) throw py::value_error("scans: at least one is wanted");
  if (!placements.empty() && placements.size() != scans.size())
    throw py::value_error("placements: as many numbers as scans are wanted");
  if (mesh_unit_m) unit_of(*mesh_unit_m, "mesh_unit_m");
  const std::optional<Pose> first = guess ? std::optional(pose_of(*guess)) : std::nullopt;
  std::vector<std::string> names;
  for (const std::filesystem::path& scan : scans) names.push_back(scan.string());
  return interruptible([&](const Observer& observer) {
    auto out = std::make_shared<Registration>();
    out->input = read_register_input(names, mesh.string(), mesh_unit_m, {}, observer);
    for (std::size_t i = 0; i < placements.size(); ++i) out->input.scans[i].placement = placements[i];
    out->result = register_input(out->input, first, config, observer);
    return out;
  });
}

std::vector<std::string> names_of(const Registration& of) {
  std::vector<std::string> out;
  for (const RegisteredScan& scan : of.result.scans) out.push_back(scan.name);
  return out;
}

void write(const Registration& of, const std::filesystem::path& folder) {
  const LockFreed unlocked;
  OutputFolder out(folder, naming_added(is_registration_folder));
  write_registration(out.path(), of.result, of.input.scans, of.input.onto);
  out.commit();
}

SharedScene scene_of(const Registration& of) {
  return interruptible([&](const Observer&) {
    if (of.input.onto.folder.empty()) return SharedScene(make_scene(of.result, of.input.mesh(), of.input.unit_m()));
    Scene scene = of.input.onto.scene;
    add_scans(scene, of.result, place_scans(of.input.onto, names_of(of)), of.input.scans, of.input.onto.date);
    return SharedScene(std::move(scene));
  });
}

py::dict scan_arrays(const py::object& self, std::size_t index) {
  const RegisteredScan& scan = self.cast<const Registration&>().scan(index);
  py::dict out;
  out["s_m"] = view(scan.path.s_m, self);
  out["point_m"] = view(scan.path.p_mesh_m, self);
  out["triangle"] = view(scan.path.triangle, self);
  out["height_m"] = view(scan.process.profile.height_m, self);
  out["height_sigma_m"] = view(scan.process.profile.sigma_m, self);
  out["texture_m"] = view(scan.process.profile.texture_m, self);
  out["texture_sigma_m"] = view(scan.process.profile.texture_sigma_m, self);
  return out;
}

}  // namespace

void add_registering(py::module_& module) {
  py::class_<Registration, std::shared_ptr<Registration>>(
      module, "Registration", "Scans aligned with a mesh, and their textures along their paths over it.")
      .def_property_readonly(
          "trustworthy", [](const Registration& of) { return of.result.trustworthy; }, "No verdict is invalid.")
      .def_property_readonly(
          "verdict", [](const Registration& of) { return of.result.verdict; },
          "The verdicts in a sentence; empty if none is invalid or limited.")
      .def_property_readonly(
          "verdicts", [](const Registration& of) { return verdicts_of(of.result.verdicts); },
          "The worst first: code, severity, message, remedy.")
      .def_property_readonly("names", &names_of, "The scans' names.")
      .def(
          "T_mesh_world",
          [](const Registration& of, std::size_t scan) {
            return matrix_of(of.result.registration_of(of.scan(scan)).T_mesh_world);
          },
          py::arg("scan") = 0, "(4, 4) from the world frame of a scan's tracker to the mesh's frame, m. A copy.")
      .def(
          "covariance",
          [](const Registration& of, std::size_t scan) {
            const Eigen::Matrix<double, 6, 6, Eigen::RowMajor> of_pose =
                of.result.registration_of(of.scan(scan)).covariance;
            return py::array_t<double>({py::ssize_t{6}, py::ssize_t{6}}, of_pose.data());
          },
          py::arg("scan") = 0,
          "(6, 6) of the pose's error: rotation (rad) and shift (m) about the points' mean. A copy.")
      .def("scan", &scan_arrays, py::arg("index"),
           "A dict of a scan's arrays, one entry per point of its profile over the mesh: s_m, point_m (n, 3) in the "
           "mesh's frame, triangle, height_m, height_sigma_m, texture_m, texture_sigma_m.")
      .def_property_readonly(
          "summary",
          [](const Registration& of) {
            const std::vector<std::string> names = names_of(of);
            return py::module_::import("json").attr("loads")(
                registration_json(of.result, place_scans(of.input.onto, names),
                                  std::vector<std::vector<std::string>>(names.size()), of.input.onto)
                    .dump_repaired());
          },
          "All of registration.json as a dict.")
      .def("scene", &scene_of, "The mesh, or the scene that was given, with the scans' textures; for a Renderer.")
      .def("write", &write, py::arg("folder"),
           "Write registration.json, scene.json and the scans' results into a folder, as `asperity register` does; "
           "one that holds anything but a registration is not replaced.")
      .def(
          "__len__", [](const Registration& of) { return of.result.scans.size(); }, "The number of scans.")
      .def("__repr__", [](const Registration& of) {
        return "<asperity.Registration: scans " + std::to_string(of.result.scans.size()) + ", " +
               (of.result.trustworthy ? "valid" : "invalid") + ">";
      });
  refuse_unmade<Registration>();
  module.def("register_scans", &register_recordings, py::arg("scans"), py::arg("mesh"),
             py::arg("mesh_unit_m") = py::none(), py::arg("guess") = py::none(),
             py::arg("placements") = std::vector<int>(), py::arg("settings") = py::dict(),
             "Align scans (folders of recordings, or CSV files of paths) with a mesh file, or with the mesh of a "
             "scene.json, to which they are then added, and measure their textures over it. mesh_unit_m: as unit_m of "
             "read_mesh. guess: T_mesh_world as x, y, z (m), qw, qx, qy, qz or as a matrix (4, 4), such as that of "
             "align_points; without it the whole mesh is searched. placements: a number per scan, equal where the "
             "object was not moved in between. settings: those of settings('register').");
}

}  // namespace asperity::python
