// The mesh, the path and what belongs to them, in a view. The view's origin is the middle of the mesh's box.
import { type BufferAttribute, Color, Group, type Material, type Mesh, type Object3D, type Points, Vector3 } from "three";
import { TransformControls } from "three/examples/jsm/controls/TransformControls.js";
import type { Block } from "../../net/block";
import { themeColour } from "../../plot/colours";
import { newGesture } from "../../state/document";
import { dotsFromPoints, meshFromArrays, meshFromBlock, setColours, sphere } from "../../view3d/helpers";
import type { View } from "../../view3d/View";
import { numberLabel } from "./numberLabel";
import { nearestOnScreen, type Pick, type Screen } from "./picks";
import { placePath, pointsApart, poseOfPath, type Frame, type Point, type Pose } from "./pose";
import { residualColours } from "./residuals";
import { areas, colourOf, markedPoints } from "./scans";

const kReach_px = 14;
const kRim_px = 10;

export interface AlignSceneEvents {
  moved(pose: Pose, gesture: string): void;
}

export class AlignScene {
  private readonly path = new Group();
  private readonly ghost = new Group();
  private readonly marks = new Group();
  private readonly gizmo: TransformControls;
  private readonly helper: Object3D;
  private readonly frame: Frame;
  private readonly size_m: number;
  private readonly points: Float32Array;
  private readonly pathOf: ArrayLike<number>;
  private readonly paths: number;
  private readonly areas = new Group();
  private apart = false;
  private mesh: Mesh;
  private dots: Points;
  private overlaps: Points | null = null;
  private gesture = "";

  constructor(
    private readonly view: View,
    private readonly block: Block,
    events: AlignSceneEvents,
  ) {
    this.frame = { middle_world_m: block.head.middle_world_m, origin_m: block.head.origin_m };
    this.size_m = new Vector3(...block.head.high_m).sub(new Vector3(...block.head.low_m)).length();
    this.points = block.arrays.path_points as Float32Array;
    this.pathOf = block.arrays.path_of ?? [];
    this.paths = (block.head.paths as string[]).length;
    const mesh = meshFromBlock(block, "positions", "indices", { colour: themeColour("--view-mesh") });
    // The path is on the surface: the surface is drawn slightly behind its true depth.
    mesh.material.polygonOffset = true;
    mesh.material.polygonOffsetFactor = 2;
    mesh.material.polygonOffsetUnits = 8;
    this.mesh = view.add(mesh);
    view.add(this.areas);
    this.drawAreas();
    this.dots = dotsFromPoints(this.points, new Float32Array(this.points.length).fill(0.5), 5);
    drawLate(this.dots, 2);
    this.path.add(this.dots);
    this.ghost.add(dotsFromPoints(this.points, themeColour("--text-1"), 2));
    this.ghost.visible = false;
    view.add(this.path);
    view.add(this.ghost);
    view.add(this.marks);
    this.gizmo = new TransformControls(view.camera, view.canvas);
    this.gizmo.setSize(0.8);
    this.helper = this.gizmo.getHelper();
    view.scene.add(this.helper);
    this.gizmo.addEventListener("change", view.invalidate);
    this.gizmo.addEventListener("axis-changed", ({ value }) => (view.controls.enabled = !value));
    this.gizmo.addEventListener("dragging-changed", ({ value }) => {
      view.controls.enabled = !value;
      this.gesture = newGesture();
    });
    this.gizmo.addEventListener("objectChange", () => events.moved(poseOfPath(this.path, this.frame), this.gesture));
  }

  /** Shows mesh and path from the position of the viewer. */
  fit(): void {
    this.view.fit(this.mesh);
  }

  /** With `poses`, one a path, each path has its own pose; the group's pose is that of the first. */
  place(pose: Pose, poses: readonly Pose[] | null = null): void {
    if (!this.gizmo.dragging) placePath(this.path, pose, this.frame);
    if (poses || this.apart) {
      this.apart = poses !== null;
      const positions = this.dots.geometry.getAttribute("position") as BufferAttribute;
      positions.array.set(poses ? pointsApart(this.points, this.pathOf, pose, poses, this.frame) : this.points);
      positions.needsUpdate = true;
      this.dots.geometry.computeBoundingSphere();
    }
    this.view.invalidate();
  }

  placeGhost(pose: Pose | null): void {
    this.ghost.visible = pose !== null;
    if (pose) placePath(this.ghost, pose, this.frame);
    this.view.invalidate();
  }

  setTool(mode: "translate" | "rotate" | null): void {
    if (mode) {
      this.gizmo.setMode(mode);
      this.gizmo.attach(this.path);
    } else {
      this.gizmo.detach();
      this.view.controls.enabled = true;
    }
    this.view.invalidate();
  }

  setTranslucent(on: boolean): void {
    const material = this.mesh.material as Material;
    material.transparent = on;
    material.opacity = on ? 0.35 : 1;
    material.depthWrite = !on;
    material.needsUpdate = true;
    this.view.invalidate();
  }

  /** By distances in any unit, dark at 0 and bright at `limit`. */
  colour(distance: Float32Array, limit: number): void {
    if (3 * distance.length !== this.points.length) return;
    setColours(this.dots, residualColours(distance, limit));
    this.view.invalidate();
  }

  /** A rim about the points at which scans overlap; null: none. */
  markOverlaps(overlap: Uint8Array | null): void {
    if (this.overlaps) this.view.remove(this.overlaps);
    this.overlaps = null;
    if (overlap && 3 * overlap.length === this.points.length) {
      const marked = markedPoints(this.dots.geometry.getAttribute("position").array, overlap);
      this.overlaps = dotsFromPoints(marked, themeColour("--text-1"), kRim_px);
      drawLate(this.overlaps, 1);
      // A rim hides no dot, also not that of a neighbour.
      (this.overlaps.material as Material).depthWrite = false;
      this.path.add(this.overlaps);
    }
    this.view.invalidate();
  }

  /** Each path in the colour of its scan. */
  colourByScan(): void {
    const colours = new Float32Array(this.points.length);
    const colour = new Color();
    for (let at = 0; at < this.pathOf.length; ++at) {
      colour.set(themeColour(`--series-${colourOf(this.pathOf[at]!)}`));
      colours.set([colour.r, colour.g, colour.b], 3 * at);
    }
    setColours(this.dots, colours);
    this.view.invalidate();
  }

  /** The textured areas of the scene in the colours of its scans; those with several textures dark. */
  showAreas(on: boolean): void {
    this.areas.visible = on;
    this.view.invalidate();
  }

  takeColours(): void {
    this.drawAreas();
    (this.mesh.material as unknown as { color: Color }).color.set(themeColour("--view-mesh"));
    ((this.ghost.children[0] as Points).material as unknown as { color: Color }).color.set(themeColour("--text-1"));
    this.view.invalidate();
  }

  /** Numbered balls at picked pairs: those of the path move with it. */
  mark(picks: readonly Pick[], half: Point | null): void {
    const own: (Object3D | null)[] = [this.dots, this.overlaps];
    const old = [...this.path.children.filter((child) => !own.includes(child)), ...this.marks.children];
    for (const mark of old) this.view.remove(mark);
    picks.forEach(({ path, mesh }, index) => {
      this.path.add(this.marker(`${index + 1}`, this.inPath(path), "--series-2"));
      this.marks.add(this.marker(`${index + 1}`, new Vector3(...mesh).sub(new Vector3(...this.frame.origin_m)), "--series-1"));
    });
    if (half) this.path.add(this.marker(`${picks.length + 1}`, this.inPath(half), "--series-2"));
    this.view.invalidate();
  }

  /** The point of the path under a position of the window, world frame. */
  pathPointAt(x: number, y: number): Point | null {
    const place = this.view.canvas.getBoundingClientRect();
    this.path.updateMatrixWorld();
    const screen: (Screen | null)[] = [];
    const p = new Vector3();
    for (let at = 0; at < this.points.length; at += 3) {
      p.fromArray(this.points, at).applyMatrix4(this.path.matrixWorld).project(this.view.camera);
      const seen = Math.abs(p.z) <= 1;
      screen.push(seen ? { x: place.left + ((p.x + 1) / 2) * place.width, y: place.top + ((1 - p.y) / 2) * place.height } : null);
    }
    const found = nearestOnScreen(screen, { x, y }, kReach_px);
    if (found < 0) return null;
    const world = p.fromArray(this.points, 3 * found).add(new Vector3(...this.frame.middle_world_m));
    return [world.x, world.y, world.z];
  }

  /** The point of the mesh under a position of the window, mesh frame. */
  meshPointAt(x: number, y: number): Point | null {
    const hit = this.view.aim(x, y).intersectObject(this.mesh, false)[0];
    if (!hit) return null;
    const p = hit.point.clone().add(new Vector3(...this.frame.origin_m));
    return [p.x, p.y, p.z];
  }

  destroy(): void {
    this.gizmo.detach();
    this.gizmo.dispose();
    this.helper.removeFromParent();
    for (const part of [this.mesh, this.areas, this.path, this.ghost, this.marks]) this.view.remove(part);
    this.view.controls.enabled = true;
  }

  private drawAreas(): void {
    for (const part of [...this.areas.children]) this.view.remove(part);
    const { positions, indices, laid_triangle, laid_texture, covered_triangle } = this.block.arrays;
    if (!positions || !indices || !laid_triangle || !laid_texture) return;
    const draw = (corners: readonly number[], colour: string, opacity: number, behind: number) => {
      const part = meshFromArrays(positions, corners, { colour, opacity });
      part.material.polygonOffset = true;
      part.material.polygonOffsetFactor = behind;
      part.material.polygonOffsetUnits = 4 * behind;
      this.areas.add(part);
    };
    for (const [texture, corners] of areas(indices, laid_triangle, laid_texture))
      draw(corners, themeColour(`--series-${colourOf(this.paths + texture - 1)}`), 0.55, 1.5);
    const several = areas(indices, covered_triangle ?? [], new Uint8Array(covered_triangle?.length ?? 0)).get(0);
    if (several) draw(several, themeColour("--text-1"), 0.6, 1);
  }

  private inPath(p_world_m: Point): Vector3 {
    return new Vector3(...p_world_m).sub(new Vector3(...this.frame.middle_world_m));
  }

  private marker(text: string, at: Vector3, colour: string): Group {
    const group = new Group();
    const ball = sphere(0.006 * this.size_m, themeColour(colour));
    const label = numberLabel(text, 0.035 * this.size_m, themeColour("--panel"), themeColour(colour));
    label.position.set(0, 0, 0.025 * this.size_m);
    group.add(ball, label);
    group.position.copy(at);
    return group;
  }
}

/** After all that is opaque or has no order, and those of a lower order. */
function drawLate(points: Points, order: number): void {
  points.renderOrder = order;
  (points.material as Material).transparent = true;
}
