// What a changed unit of meshes takes with it: poses, picks and strokes are in metres of the mesh as it was read before.
import { isSameUnit, takesProjectUnit, textOfLength } from "../ui/meshUnits";

export interface Change {
  path: string;
  value: unknown;
  label: string;
}

interface Decided {
  align?: { mesh: string; mesh_unit: string; picks: unknown[]; T_mesh_world?: unknown; registered?: unknown };
  paint?: { object: string; unit_m?: number; strokes: unknown[]; current: number };
}

/**
 * The edits that give the project another unit. The unit is the last of them, so that undo, one edit at a time, never
 * shows the poses and strokes of one scale on the mesh of another.
 */
export function changesOfUnit({ align, paint }: Decided, from: string, to: string): Change[] {
  const unit = { path: "/project/mesh_unit", value: to, label: "change the project's mesh unit" };
  if (isSameUnit(from, to)) return [unit];
  const out: Change[] = [];
  if (align && takesProjectUnit(align.mesh, align.mesh_unit)) {
    const { T_mesh_world, registered, ...kept } = align;
    if (T_mesh_world || registered || align.picks.length > 0) out.push({ path: "/align", value: { ...kept, picks: [] }, label: "remove the pose: another mesh unit" });
  }
  if (paint && paint.strokes.length > 0 && takesProjectUnit(paint.object, paint.unit_m === undefined ? "" : textOfLength(paint.unit_m))) {
    out.push({ path: "/paint", value: { ...paint, strokes: [], current: -1 }, label: "remove the strokes: another mesh unit" });
  }
  return [...out, unit];
}
