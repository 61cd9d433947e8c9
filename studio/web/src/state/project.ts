// What holds for the whole project: the unit of meshes without one, and the axis that is up in views of meshes.
import { computed } from "@preact/signals";
import { edit, section } from "./document";

export interface ProjectSection {
  /** As text: "mm", "0.06m". */
  mesh_unit: string;
  up: "y" | "z";
}

const kept = section<ProjectSection | undefined>("project");

export const project = computed<ProjectSection>(() => ({ mesh_unit: "m", up: "z", ...kept.value }));

export const setMeshUnit = (mesh_unit: string) => edit("/project/mesh_unit", mesh_unit, "change the project's mesh unit");
export const setUp = (up: "y" | "z") => edit("/project/up", up, `show ${up} upwards`);
