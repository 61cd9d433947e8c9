// What a user decides on the page: the document's section "feel", and how it is changed.
import { edit, section } from "../../state/document";

export interface FeelSection {
  scene?: string;
  mesh_unit?: string;
  height_maps?: string[];
  tile_mm?: number;
  range_mm?: number;
  device?: string;
  replay?: string;
  mapped?: boolean;
  settings?: Record<string, unknown>;
  max_force_N?: number | null;
  textures?: Record<string, string>;
}

export const feelSection = section<FeelSection | undefined>("feel");

/** What keeps a scene and height maps apart: the section holds one of them. */
export async function chooseScene(name: string): Promise<void> {
  const gesture = `scene ${Date.now()}`;
  if (feelSection.value?.height_maps?.length) await edit("/feel/height_maps", [], "remove the height maps", gesture);
  if (Object.keys(feelSection.value?.textures ?? {}).length) await edit("/feel/textures", {}, "the scene's own textures", gesture);
  // A unit is that of the file for which it was chosen.
  if (feelSection.value?.mesh_unit && name !== feelSection.value.scene) await edit("/feel/mesh_unit", "", "remove the former mesh's unit", gesture);
  await edit("/feel/scene", name, name ? `touch ${name}` : "no scene", gesture);
}

export async function chooseHeightMaps(names: string[]): Promise<void> {
  const gesture = `height maps ${Date.now()}`;
  if (feelSection.value?.scene) await edit("/feel/scene", "", "remove the scene", gesture);
  if (Object.keys(feelSection.value?.textures ?? {}).length) await edit("/feel/textures", {}, "the maps' own textures", gesture);
  await edit("/feel/height_maps", names, names.length ? "touch height maps" : "remove the height maps", gesture);
}

/** The key of a JSON pointer. */
export const pointerKey = (key: string): string => key.replaceAll("~", "~0").replaceAll("/", "~1");

/** A setting by its path; null: as the start has it. */
export const setSetting = (path: string, value: unknown, gesture = ""): Promise<void> =>
  edit(`/feel/settings/${pointerKey(path)}`, value, value === null ? `reset ${path}` : `change ${path}`, gesture);

/** The value that a form gives as text, as the document keeps it. */
export function settingValue(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return text;
  }
}
