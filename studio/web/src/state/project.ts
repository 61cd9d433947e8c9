// What holds for the whole project: the unit of meshes without one, and the axis that is up in views of meshes.
import { computed } from "@preact/signals";
import { edit, section, valueAt } from "./document";
import { changesOfUnit } from "./unitChange";

export interface ProjectSection {
  /** As text: "mm", "0.06m". */
  mesh_unit: string;
  up: "y" | "z";
}

const kept = section<ProjectSection | undefined>("project");

export const project = computed<ProjectSection>(() => ({ mesh_unit: "m", up: "z", ...kept.value }));

/** Also removes the poses and strokes that are of another scale then. */
export async function setMeshUnit(mesh_unit: string): Promise<void> {
  const changes = changesOfUnit({ align: valueAt("/align"), paint: valueAt("/paint") }, project.value.mesh_unit, mesh_unit);
  for (const { path, value, label } of changes) await edit(path, value, label);
}

export const setUp = (up: "y" | "z") => edit("/project/up", up, `show ${up} upwards`);
