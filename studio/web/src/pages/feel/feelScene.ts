// The scene as three.js shows it: bare surface, and textured areas by tint, a pattern of their heights, and an outline.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DataTexture,
  DoubleSide,
  Group,
  LinearFilter,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshStandardMaterial,
  RepeatWrapping,
  RGBAFormat,
} from "three";
import { MeshBVH } from "three-mesh-bvh";
import type { Block } from "../../net/block";
import { themeColour } from "../../plot/colours";
import { areaOutline, greys, trianglesByTexture, uvOf, type TextureHead } from "./feelAreas";

const kTint = 0.55;

export const seriesOf = (texture: number): number => (texture % 8) + 1;

/** All objects of a block of feel.open. Colours are those of the theme: made again when it changes. */
export function makeFeelScene(block: Block): Group {
  const group = new Group();
  for (let k = 0; k < block.head.objects; ++k) addObject(group, block, k);
  return group;
}

function addObject(group: Group, block: Block, k: number): void {
  const vertices = block.arrays[`vertices_${k}`]!;
  const triangles = block.arrays[`triangles_${k}`]!;
  const texture = block.arrays[`texture_${k}`];
  const heads = block.head.textures as TextureHead[];
  const normals = smoothNormals(vertices, triangles);
  for (const [index, rows] of trianglesByTexture(texture, triangles.length / 3)) {
    const head = heads[index];
    const xy = block.arrays[`xy_${k}`];
    const uv = head && xy ? uvOf(xy, rows, head) : null;
    const colour = new Color(themeColour("--view-mesh"));
    if (head) colour.lerp(new Color(themeColour(`--series-${seriesOf(index)}`)), kTint);
    const map = head && uv ? patternOf(block, index, head) : null;
    group.add(areaMesh(vertices, triangles, normals, rows, colour, uv, map));
  }
  if (texture) group.add(outlineOf(vertices, areaOutline(triangles, texture)));
}

/** Unit normals of the vertices, weighted by area: a seam between areas is not seen as an edge. */
function smoothNormals(vertices: ArrayLike<number>, triangles: ArrayLike<number>): ArrayLike<number> {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(vertices), 3));
  geometry.setIndex(new BufferAttribute(Uint32Array.from(triangles), 1));
  geometry.computeVertexNormals();
  return geometry.getAttribute("normal").array;
}

function areaMesh(
  vertices: ArrayLike<number>,
  triangles: ArrayLike<number>,
  normals: ArrayLike<number>,
  rows: Uint32Array,
  colour: Color,
  uv: Float32Array | null,
  map: DataTexture | null,
): Mesh {
  const points = new Float32Array(9 * rows.length);
  const directions = new Float32Array(9 * rows.length);
  rows.forEach((row, at) => {
    for (let corner = 0; corner < 3; ++corner) {
      const vertex = triangles[3 * row + corner]!;
      for (let axis = 0; axis < 3; ++axis) {
        points[9 * at + 3 * corner + axis] = vertices[3 * vertex + axis]!;
        directions[9 * at + 3 * corner + axis] = normals[3 * vertex + axis]!;
      }
    }
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(points, 3));
  geometry.setAttribute("normal", new BufferAttribute(directions, 3));
  if (uv) geometry.setAttribute("uv", new BufferAttribute(uv, 2));
  if (points.length > 0) geometry.boundsTree = new MeshBVH(geometry, { indirect: true });
  const material = new MeshStandardMaterial({ color: colour, map, roughness: 0.8, metalness: 0.02, side: DoubleSide });
  return new Mesh(geometry, material);
}

function outlineOf(vertices: ArrayLike<number>, edges: Uint32Array): LineSegments {
  const points = new Float32Array(3 * edges.length);
  edges.forEach((vertex, at) => {
    for (let axis = 0; axis < 3; ++axis) points[3 * at + axis] = vertices[3 * vertex + axis]!;
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(points, 3));
  const lines = new LineSegments(geometry, new LineBasicMaterial({ color: new Color(themeColour("--text-1")) }));
  lines.raycast = () => undefined;
  return lines;
}

/** Heights as greys, or stripes for a texture that has none. */
function patternOf(block: Block, index: number, head: TextureHead): DataTexture {
  const heights = block.arrays[`height_${index}`];
  const [rows, columns] = block.shapes[`height_${index}`] ?? [1, 8];
  const grey = heights ? greys(heights, head.highest_m, 90) : Uint8Array.from([150, 150, 150, 255, 255, 255, 255, 255]);
  const pixels = new Uint8Array(4 * grey.length);
  grey.forEach((value, at) => pixels.set([value, value, value, 255], 4 * at));
  const texture = new DataTexture(pixels, columns!, rows!, RGBAFormat);
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearFilter;
  texture.anisotropy = 4;
  texture.needsUpdate = true;
  return texture;
}
