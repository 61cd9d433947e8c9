// What the open scan and mesh depend on: with another key they are opened again.

export interface Named {
  paths?: string[];
  mesh?: string;
  mesh_unit?: string;
  config?: Record<string, string>;
}

/**
 * A key of all that decides how scans and mesh are read; "": nothing to open. The page's unit and the project's are apart
 * in it: the project's unit is checked where it is only assumed, and is not that of a glTF file.
 */
export function openingKey({ paths = [], mesh = "", mesh_unit = "", config = {} }: Named, projectUnit: string): string {
  if (!mesh || paths.length === 0) return "";
  const points = Object.entries(config).filter(([path]) => path.startsWith("process.") || path.startsWith("points."));
  return JSON.stringify([paths, mesh, mesh_unit, projectUnit, points]);
}
