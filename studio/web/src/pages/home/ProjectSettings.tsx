import { project, setMeshUnit, setUp } from "../../state/project";
import { MeshUnitField } from "../../ui/MeshUnitField";
import { Select } from "../../ui/Select";
import { complain } from "../../ui/toast";

/** What holds for the whole project. */
export function ProjectSettings() {
  const { mesh_unit, up } = project.value;
  return (
    <div class="home-settings">
      <MeshUnitField label="Unit of meshes" value={mesh_unit} onChange={(unit) => void setMeshUnit(unit).catch(complain)} testId="project-unit" />
      <p class="field-hint">For files that state no unit (OBJ, STL, PLY, OFF). The pages can choose another for one mesh.</p>
      <Select
        label="Upward axis"
        value={up}
        options={[
          { value: "z", label: "z" },
          { value: "y", label: "y" },
        ]}
        onChange={(axis) => void setUp(axis as "y" | "z").catch(complain)}
        testId="project-up"
      />
      <p class="field-hint">In the 3D views of meshes. Positions and files are not changed.</p>
    </div>
  );
}
