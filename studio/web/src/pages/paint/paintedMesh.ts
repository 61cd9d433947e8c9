// The painted mesh as three.js shows it: each triangle for itself, so that it can have its own colour and coordinates.
import { BufferAttribute, type BufferGeometry, Color, DataTexture, type Mesh, type MeshStandardMaterial, NearestFilter, RepeatWrapping, RGBAFormat } from "three";
import type { Block } from "../../net/block";
import { themeColour } from "../../plot/colours";
import { meshFromArrays } from "../../view3d/helpers";
import { type Show, warpPart } from "./painting";

export type PaintedMesh = Mesh<BufferGeometry, MeshStandardMaterial>;

const kSeries = 8;

/** The mesh of a block of paint.show; hit.faceIndex is the triangle's number in it. */
export function makePaintedMesh(block: Block): PaintedMesh {
  const positions = block.arrays.positions!;
  const indices = block.arrays.indices!;
  const normals = block.arrays.normals!;
  const origin = block.head.origin_m as number[];
  const points = new Float32Array(3 * indices.length);
  const directions = new Float32Array(3 * indices.length);
  const corners = new Uint32Array(indices.length);
  for (let corner = 0; corner < indices.length; ++corner) {
    const vertex = indices[corner]!;
    corners[corner] = corner;
    for (let axis = 0; axis < 3; ++axis) {
      points[3 * corner + axis] = positions[3 * vertex + axis]! + origin[axis]!;
      directions[3 * corner + axis] = normals[3 * vertex + axis]!;
    }
  }
  const mesh = meshFromArrays(points, corners, { vertexColours: new Float32Array(3 * indices.length) });
  mesh.geometry.setAttribute("normal", new BufferAttribute(directions, 3));
  mesh.geometry.setAttribute("uv", new BufferAttribute(new Float32Array(2 * indices.length), 2));
  return mesh;
}

/** Colours it: by texture, by texture under a chequer of its coordinates, or by how they warp. */
export function colourPaintedMesh(mesh: PaintedMesh, block: Block, show: Show, cell_mm: number): void {
  const texture = block.arrays.texture!;
  const stretch = block.arrays.stretch!;
  const folded = block.arrays.folded!;
  const xy_mm = block.arrays.xy_mm!;
  const bare = new Color(themeColour("--view-mesh"));
  const series = Array.from({ length: kSeries }, (_, index) => new Color(themeColour(`--series-${index + 1}`)));
  const fold = new Color(themeColour("--bad"));
  const ends = [new Color(0x2166ac), new Color(0xf2f2f2), new Color(0xb2182b)] as const;
  const colour = new Color();
  const colours = mesh.geometry.getAttribute("color").array as Float32Array;
  const uv = mesh.geometry.getAttribute("uv").array as Float32Array;
  for (let triangle = 0; triangle < texture.length; ++triangle) {
    const index = texture[triangle]!;
    if (index < 0) colour.copy(bare);
    else if (show !== "warp") colour.copy(bare).lerp(series[(index + kSeries - 1) % kSeries]!, 0.75);
    else if (folded[triangle]) colour.copy(fold);
    else {
      const part = warpPart(stretch[triangle]!);
      colour.lerpColors(ends[1], part < 0 ? ends[0] : ends[2], Math.abs(part));
    }
    for (let corner = 3 * triangle; corner < 3 * triangle + 3; ++corner) {
      colour.toArray(colours, 3 * corner);
      uv[2 * corner] = index < 0 ? 0 : xy_mm[2 * corner]! / (2 * cell_mm);
      uv[2 * corner + 1] = index < 0 ? 0 : xy_mm[2 * corner + 1]! / (2 * cell_mm);
    }
  }
  mesh.geometry.getAttribute("color").needsUpdate = true;
  mesh.geometry.getAttribute("uv").needsUpdate = true;
  mesh.material.map?.dispose();
  mesh.material.map = show === "warp" ? null : chequer(show === "coordinates" ? 130 : 215);
  mesh.material.needsUpdate = true;
}

function chequer(dark: number): DataTexture {
  const values = [255, dark, dark, 255].flatMap((value) => [value, value, value, 255]);
  const texture = new DataTexture(new Uint8Array(values), 2, 2, RGBAFormat);
  texture.wrapS = RepeatWrapping;
  texture.wrapT = RepeatWrapping;
  texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}
