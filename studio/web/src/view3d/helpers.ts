// Things to show, made from the arrays of a block. Positions in metres.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  type ColorRepresentation,
  ConeGeometry,
  CylinderGeometry,
  DoubleSide,
  Group,
  Line,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Matrix4,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  Points,
  PointsMaterial,
  SphereGeometry,
  Vector3,
} from "three";
import { MeshBVH } from "three-mesh-bvh";
import type { Block } from "../net/block";

export interface MeshOptions {
  colour?: ColorRepresentation;
  opacity?: number;
  /** Flat triangles, as they are; smooth without it. */
  flat?: boolean;
  /** Three values from 0 to 1 a vertex; replaces `colour`. */
  vertexColours?: Float32Array;
}

/**
 * A mesh from a block's arrays, n × 3 positions and m × 3 vertex indices, with a tree for fast picking: hit.faceIndex
 * is the row of the triangle in the block.
 */
export function meshFromBlock(block: Block, positions = "positions", triangles = "triangles", options: MeshOptions = {}): Mesh<BufferGeometry, MeshStandardMaterial> {
  const points = block.arrays[positions];
  const corners = block.arrays[triangles];
  if (!points || !corners) throw new Error(`The server has sent a mesh without ${points ? triangles : positions}.`);
  return meshFromArrays(points, corners, options);
}

export function meshFromArrays(points: ArrayLike<number>, corners: ArrayLike<number>, options: MeshOptions = {}): Mesh<BufferGeometry, MeshStandardMaterial> {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(points), 3));
  geometry.setIndex(new BufferAttribute(Uint32Array.from(corners), 1));
  if (options.vertexColours) geometry.setAttribute("color", new BufferAttribute(options.vertexColours, 3));
  geometry.computeVertexNormals();
  if (corners.length > 0) geometry.boundsTree = new MeshBVH(geometry, { indirect: true });
  const { opacity = 1 } = options;
  const material = new MeshStandardMaterial({
    color: options.vertexColours ? 0xffffff : (options.colour ?? 0xaab6be),
    vertexColors: options.vertexColours !== undefined,
    flatShading: options.flat ?? false,
    roughness: 0.75,
    metalness: 0.05,
    side: DoubleSide,
    transparent: opacity < 1,
    opacity,
    depthWrite: opacity >= 1,
  });
  return new Mesh(geometry, material);
}

/** Colours of a mesh's vertices or a line's points: three values from 0 to 1 each. */
export function setColours(object: Object3D, colours: Float32Array): void {
  const { geometry } = object as Mesh;
  const there = geometry.getAttribute("color") as BufferAttribute | undefined;
  if (there && there.array.length === colours.length) {
    there.array.set(colours);
    there.needsUpdate = true;
  } else geometry.setAttribute("color", new BufferAttribute(colours, 3));
}

/** A line through n × 3 points; `colours` is one colour, or three values from 0 to 1 a point. */
export function lineFromPoints(points: ArrayLike<number>, colours: ColorRepresentation | Float32Array): Line<BufferGeometry, LineBasicMaterial> {
  const { geometry, each } = pointGeometry(points, colours);
  return new Line(geometry, new LineBasicMaterial({ color: each ? 0xffffff : (colours as ColorRepresentation), vertexColors: each }));
}

/** Separate lines, from each even point to the next. */
export function segmentsFromPoints(points: ArrayLike<number>, colours: ColorRepresentation | Float32Array): LineSegments<BufferGeometry, LineBasicMaterial> {
  const { geometry, each } = pointGeometry(points, colours);
  return new LineSegments(geometry, new LineBasicMaterial({ color: each ? 0xffffff : (colours as ColorRepresentation), vertexColors: each }));
}

/** Dots of `size_px` pixels at n × 3 points. */
export function dotsFromPoints(points: ArrayLike<number>, colours: ColorRepresentation | Float32Array, size_px = 4): Points<BufferGeometry, PointsMaterial> {
  const { geometry, each } = pointGeometry(points, colours);
  const material = new PointsMaterial({ color: each ? 0xffffff : (colours as ColorRepresentation), vertexColors: each, size: size_px, sizeAttenuation: false });
  return new Points(geometry, material);
}

function pointGeometry(points: ArrayLike<number>, colours: ColorRepresentation | Float32Array) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(points), 3));
  const each = colours instanceof Float32Array;
  if (each) geometry.setAttribute("color", new BufferAttribute(colours, 3));
  return { geometry, each };
}

export function sphere(radius_m: number, colour: ColorRepresentation): Mesh<SphereGeometry, MeshStandardMaterial> {
  return new Mesh(new SphereGeometry(radius_m, 24, 16), new MeshStandardMaterial({ color: colour, roughness: 0.5 }));
}

/** An arrow of unit length along +y in its own frame; pointArrow() lays it. */
export function arrow(colour: ColorRepresentation): Group {
  const material = new MeshStandardMaterial({ color: colour, roughness: 0.6 });
  const shaft = new Mesh(new CylinderGeometry(0.02, 0.02, 0.8, 12), material);
  shaft.position.y = 0.4;
  const head = new Mesh(new ConeGeometry(0.06, 0.2, 16), material);
  head.position.y = 0.9;
  const group = new Group();
  group.add(shaft, head);
  return group;
}

const kY = new Vector3(0, 1, 0);
const direction = new Vector3();

/** From a point along a vector, as long as it; unseen if it is zero. */
export function pointArrow(object: Object3D, from: Vector3, vector: Vector3): void {
  const length = vector.length();
  object.visible = length > 0;
  if (!object.visible) return;
  object.position.copy(from);
  object.quaternion.setFromUnitVectors(kY, direction.copy(vector).divideScalar(length));
  object.scale.setScalar(length);
}

/** Poses an object by the 16 numbers of a 4 × 4 matrix, row by row as the server sends it. */
export function setPose(object: Object3D, rows: ArrayLike<number>): void {
  const m = new Matrix4().fromArray(Array.from(rows)).transpose();
  object.matrixAutoUpdate = true;
  m.decompose(object.position, object.quaternion, object.scale);
}

/** The 16 numbers of an object's pose, row by row. */
export function poseOf(object: Object3D): number[] {
  object.updateMatrix();
  return object.matrix.clone().transpose().toArray();
}

/** Colours from blue over white to red for −1 … 1; it can be distinguished by the colour-blind. */
export function divergingColours(values: ArrayLike<number>, limit: number): Float32Array {
  const colours = new Float32Array(3 * values.length);
  const colour = new Color();
  const ends = [new Color(0x2166ac), new Color(0xf2f2f2), new Color(0xb2182b)] as const;
  for (let index = 0; index < values.length; ++index) {
    const part = Math.max(-1, Math.min(1, values[index]! / limit));
    colour.lerpColors(ends[1], part < 0 ? ends[0] : ends[2], Math.abs(part));
    colours.set([colour.r, colour.g, colour.b], 3 * index);
  }
  return colours;
}

/** Frees the memory of an object and all below it. */
export function dispose(object: Object3D): void {
  object.traverse((part) => {
    const { geometry, material } = part as Partial<Mesh>;
    geometry?.dispose();
    for (const one of material ? [material].flat() : []) {
      (one as MeshStandardMaterial).map?.dispose();
      (one as Material).dispose();
    }
  });
}
