// Textured areas of a mesh, as numbers: which triangles, their coordinates as a picture's, where they end.

export interface TextureHead {
  name: string;
  /** Of the file: "fourier1d", "heightmap", … */
  kind: string;
  highest_m: number;
  x0_m: number;
  y0_m: number;
  width_m: number;
  height_m: number;
  kc: number | null;
  stiffness_N_per_m: number | null;
  friction: number | null;
}

export interface TextureIndex {
  object: number;
  /** The number that the mesh has for it. */
  index: number;
  file: string;
  /** Its place among the textures. */
  texture: number;
}

/** Side of the stripes of a texture without heights. */
const kStripes_m = 0.004;

/** The triangles of each texture, and of the bare surface under -1; what has none is left out. */
export function trianglesByTexture(texture: ArrayLike<number> | undefined, count: number): Map<number, Uint32Array> {
  const rows = new Map<number, number[]>();
  for (let row = 0; row < count; ++row) {
    const index = texture?.[row] ?? -1;
    const list = rows.get(index);
    if (list) list.push(row);
    else rows.set(index, [row]);
  }
  return new Map([...rows].sort((a, b) => a[0] - b[0]).map(([index, list]) => [index, Uint32Array.from(list)]));
}

/** Picture coordinates of the corners of some triangles: 0 to 1 over the size that is drawn of the texture. */
export function uvOf(xy_m: ArrayLike<number>, rows: Uint32Array, head: TextureHead): Float32Array {
  const width_m = head.width_m > 0 ? head.width_m : kStripes_m;
  const height_m = head.height_m > 0 ? head.height_m : kStripes_m;
  const uv = new Float32Array(6 * rows.length);
  rows.forEach((row, at) => {
    for (let corner = 0; corner < 3; ++corner) {
      uv[6 * at + 2 * corner] = (xy_m[6 * row + 2 * corner]! - head.x0_m) / width_m;
      uv[6 * at + 2 * corner + 1] = (xy_m[6 * row + 2 * corner + 1]! - head.y0_m) / height_m;
    }
  });
  return uv;
}

/** Heights from 0 to the highest as greys from `darkest` to 255. */
export function greys(heights_m: ArrayLike<number>, highest_m: number, darkest = 0): Uint8Array {
  const out = new Uint8Array(heights_m.length);
  const scale = highest_m > 0 ? (255 - darkest) / highest_m : 0;
  for (let at = 0; at < out.length; ++at) out[at] = Math.max(darkest, Math.min(255, Math.round(darkest + scale * heights_m[at]!)));
  return out;
}

/** Pairs of vertices: the edges between triangles of different textures, and those of textured ones at the mesh's end. */
export function areaOutline(triangles: ArrayLike<number>, texture: ArrayLike<number>): Uint32Array {
  const open = new Map<number, number>();
  const vertices = 1 + maximum(triangles);
  const out: number[] = [];
  for (let row = 0; row < texture.length; ++row) {
    for (let corner = 0; corner < 3; ++corner) {
      const a = triangles[3 * row + corner]!;
      const b = triangles[3 * row + ((corner + 1) % 3)]!;
      const key = Math.min(a, b) * vertices + Math.max(a, b);
      const other = open.get(key);
      if (other === undefined) {
        open.set(key, texture[row]!);
        continue;
      }
      if (other !== texture[row]) out.push(a, b);
      open.delete(key);
    }
  }
  for (const [key, index] of open) if (index >= 0) out.push(Math.floor(key / vertices), key % vertices);
  return Uint32Array.from(out);
}

function maximum(values: ArrayLike<number>): number {
  let most = 0;
  for (let at = 0; at < values.length; ++at) most = Math.max(most, values[at]!);
  return most;
}
