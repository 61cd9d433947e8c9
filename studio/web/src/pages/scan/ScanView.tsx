import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  CylinderGeometry,
  DynamicDrawUsage,
  Group,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshStandardMaterial,
  Quaternion,
  Vector3,
} from "three";
import { effect } from "@preact/signals";
import { dark } from "../../app/settings";
import { themeColour } from "../../plot/colours";
import { Pace } from "../../plot/pace";
import { segmentsFromPoints, sphere } from "../../view3d/helpers";
import type { View } from "../../view3d/View";
import { Viewport } from "../../view3d/Viewport";
import { cssColour, pathColour, strongest_N } from "./pathColours";
import type { SourceState } from "./scanState";
import { scan } from "./settings";
import { path, state } from "./stream";

const kMostPoints = 101_000;
const kMarker_m = 0.046;
const kReach_m = 0.08;
const kPicture_ms = 45;

/** The probe, its tip's path and the camera in the tracker's world. */
export function ScanView() {
  const zUp = scan.value.source === "hardware" && scan.value.hardware.world === "z_up";
  return (
    <Viewport label="The probe, the path of its tip and the camera, live" up={zUp ? "z" : "-y"} onReady={show} testId="scan-view">
      <div class="scan-colours" aria-hidden="true">
        <span>0 N</span>
        <span class="scan-colours-bar" style={{ background: `linear-gradient(90deg, ${ramp()})` }} />
        <span>{strongest_N}{"\u202f"}N</span>
        <span class="scan-colours-air" style={{ background: cssColour(pathColour(0, 0, dark.value)) }} />
        <span>in the air</span>
      </div>
    </Viewport>
  );
}

const ramp = () => [0, 1, 2, 3].map((step) => cssColour(pathColour((step / 3) * strongest_N, 1, dark.value))).join(", ");

function show(view: View): () => void {
  const line = new PathLine();
  const probe = new Probe();
  view.add(line.object);
  view.add(probe.object);
  let frustum: ReturnType<typeof frustumOf> | null = null;
  let camera = "";
  let fitted = false;
  const pace = new Pace(kPicture_ms);
  let posed = false;
  let frame = requestAnimationFrame(function draw(now_ms: number) {
    frame = requestAnimationFrame(draw);
    if (!pace.due(now_ms)) return;
    const changed = line.follow(dark.value);
    if (changed) probe.followTip();
    if (!changed && !posed) return;
    posed = false;
    pace.drew(now_ms);
    const near = fitted ? null : probe.surroundings();
    if (near) {
      fitted = true;
      view.fit(near);
    }
    view.invalidate();
  });
  const end = effect(() => {
    const now = state.value;
    const isDark = dark.value;
    probe.followPose(now?.source, now?.recorder?.pose ?? null, isDark);
    const next = JSON.stringify([now?.source?.camera, isDark]);
    if (next !== camera) {
      camera = next;
      view.remove(frustum);
      frustum = now?.source?.camera ? frustumOf(now.source.camera) : null;
      if (frustum) view.add(frustum);
    }
    posed = true;
  });
  return () => {
    cancelAnimationFrame(frame);
    end();
  };
}

/** A line that grows in place. */
class PathLine {
  readonly object: Line<BufferGeometry, LineBasicMaterial>;
  private readonly points = attribute();
  private readonly colours = attribute();
  private drawn = 0;
  private version = -1;
  private generation = -1;
  private wasDark = false;
  private notUploaded = Infinity; // the first point that the card has not

  constructor() {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.points);
    geometry.setAttribute("color", this.colours);
    geometry.setDrawRange(0, 0);
    this.object = new Line(geometry, new LineBasicMaterial({ vertexColors: true }));
    this.object.frustumCulled = false;
    this.object.onAfterRender = () => (this.notUploaded = Infinity);
  }

  /** Reads new data; true if there was any. */
  follow(isDark: boolean): boolean {
    if (path.version === this.version && isDark === this.wasDark) return false;
    if (path.generation !== this.generation || isDark !== this.wasDark || path.length < this.drawn) this.drawn = 0;
    this.version = path.version;
    this.generation = path.generation;
    this.wasDark = isDark;
    const { tip_m, force_N, state: how } = path.columns;
    const count = Math.min(path.length, kMostPoints);
    const from = this.drawn;
    for (let point = from; point < count; ++point) {
      this.points.array.set(tip_m.values.subarray(3 * point, 3 * point + 3), 3 * point);
      this.colours.array.set(pathColour(force_N.values[point]!, how.values[point]!, isDark), 3 * point);
    }
    this.notUploaded = Math.min(this.notUploaded, from);
    for (const part of [this.points, this.colours]) {
      part.clearUpdateRanges();
      part.addUpdateRange(3 * this.notUploaded, 3 * (count - this.notUploaded));
      part.needsUpdate = true;
    }
    this.drawn = count;
    this.object.geometry.setDrawRange(0, count);
    this.object.geometry.boundingBox = boxOf(tip_m.values.subarray(0, 3 * count));
    return true;
  }
}

/** Of the points that are there: the room behind them is not part of the path. */
function boxOf(points: Float64Array): Box3 {
  return new Box3().setFromArray(points);
}

function attribute(): BufferAttribute {
  const made = new BufferAttribute(new Float32Array(3 * kMostPoints), 3);
  made.setUsage(DynamicDrawUsage);
  return made;
}

/** Marker, shaft and tip, posed by the tracker; the tip by the live estimate where there is one. */
class Probe {
  readonly object = new Group();
  private readonly body = new Group();
  private readonly marker = segmentsFromPoints(square(), "#808080");
  private readonly shaft = new Mesh(new CylinderGeometry(0.0025, 0.0012, 1, 16), new MeshStandardMaterial({ roughness: 0.6 }));
  private readonly tip = sphere(0.0016, "#808080");
  private tipAt: Vector3 | null = null;

  constructor() {
    this.body.add(this.marker, this.shaft);
    this.object.add(this.body, this.tip);
    this.object.visible = false;
  }

  followPose(source: SourceState | undefined, pose: number[] | null, _dark: boolean): void {
    this.object.visible = source !== undefined && pose !== null;
    if (!source || !pose) {
      this.tipAt = null;
      return;
    }
    this.marker.material.color.set(themeColour("--text-2"));
    this.shaft.material.color.set(themeColour("--accent"));
    this.tip.material.color.set(themeColour("--bad"));
    this.body.position.set(pose[0]!, pose[1]!, pose[2]!);
    this.body.quaternion.copy(new Quaternion(pose[4]!, pose[5]!, pose[6]!, pose[3]!));
    const tip = new Vector3(...source.tip_in_marker_m);
    const length = Math.max(tip.length(), 1e-3);
    this.shaft.position.copy(tip).multiplyScalar(0.5);
    this.shaft.scale.set(1, length, 1);
    this.shaft.quaternion.setFromUnitVectors(new Vector3(0, -1, 0), tip.clone().divideScalar(length));
    this.tipAt = tip.applyQuaternion(this.body.quaternion).add(this.body.position);
    this.tip.position.copy(this.tipAt);
  }

  /** The probe and what its tip reaches in a stroke; null where no pose is known. */
  surroundings(): Box3 | null {
    if (!this.tipAt) return null;
    const box = new Box3().setFromObject(this.body);
    return box.union(new Box3().setFromCenterAndSize(this.tipAt, new Vector3(2, 1, 2).multiplyScalar(kReach_m)));
  }

  followTip(): void {
    const tips = path.columns.tip_m;
    if (tips.length < 3 || !this.object.visible) return;
    const [x, y, z] = tips.values.subarray(tips.length - 3) as unknown as [number, number, number];
    this.tip.position.set(x, y, z);
  }
}

function square(): number[] {
  const half = kMarker_m / 2;
  const corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
  return corners.flatMap((corner, index) => [...corner, 0, ...corners[(index + 1) % 4]!, 0]);
}

/** The camera at the world's origin with the edges of its field of view at 0.1 m. */
function frustumOf({ width, height, fx, fy, cx, cy }: NonNullable<SourceState["camera"]>) {
  const far_m = 0.1;
  const corners = [[0, 0], [width, 0], [width, height], [0, height]].map(([u, v]) => [((u! - cx) / fx) * far_m, ((v! - cy) / fy) * far_m, far_m]);
  const points = corners.flatMap((corner, index) => [0, 0, 0, ...corner, ...corner, ...corners[(index + 1) % 4]!]);
  return segmentsFromPoints(points, themeColour("--line-strong"));
}
