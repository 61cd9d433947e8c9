import {
  AmbientLight,
  Box3,
  Color,
  DirectionalLight,
  Group,
  Mesh,
  type Object3D,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { acceleratedRaycast } from "three-mesh-bvh";
import { themeColour } from "../plot/colours";
import { Ease } from "./ease";
import { boxOfFitted, type Fitted } from "./fitted";
import { Ground } from "./Ground";
import { dispose } from "./helpers";
import { listenToPointer, type PointerListener } from "./pointer";
import { directionOf, fitDistance, upOf, type Upright, type ViewName } from "./views";

const kNear_px = 5;
const kMargin = 1.15; // of the content, so that legends and buttons next to it cover little

Mesh.prototype.raycast = acceleratedRaycast;

/**
 * A scene and the camera that shows it, drawn only when something has changed: call invalidate() after each change.
 * Lengths are metres in the frame of the data. Nothing is rotated for show: in the tracker's world (x right, y down,
 * z away from the camera) only the viewing camera is upright, by `up`.
 */
export class View {
  readonly scene = new Scene();
  /** What fit() shows and the pointer hits; add to it what belongs to the data. */
  readonly content = new Group();
  readonly camera: PerspectiveCamera;
  readonly controls: OrbitControls;
  readonly raycaster = new Raycaster();
  /** Called before each picture. */
  readonly beforeDraw = new Set<() => void>();
  private readonly renderer: WebGLRenderer;
  private readonly light = new DirectionalLight(0xffffff, 2.2);
  private readonly ground = new Ground();
  private readonly observer: ResizeObserver;
  private readonly ease = new Ease();
  private frame = 0;
  /** What was fitted, until the user moves the camera: it is fitted again where the window changes. */
  private fitted: Fitted | null = null;

  /** Throws if the browser has no WebGL. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    readonly up: Upright,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: false });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.camera = new PerspectiveCamera(35, 1, 0.001, 10);
    this.camera.up.copy(upOf(up));
    this.raycaster.firstHitOnly = true;
    this.camera.add(this.light);
    this.light.position.set(0.4, 0.8, 1);
    this.scene.add(this.camera, new AmbientLight(0xffffff, 1.3), this.content, this.ground.object);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", this.invalidate);
    this.controls.addEventListener("start", () => (this.fitted = null));
    this.observer = new ResizeObserver(this.resize);
    this.observer.observe(canvas.parentElement!);
    this.takeColours();
    this.resize();
    this.fit();
    this.setView("home");
  }

  /** Draws at the next frame. */
  readonly invalidate = (): void => {
    if (!this.frame) this.frame = requestAnimationFrame(this.draw);
  };

  /** Adds to the content, and draws. */
  add<T extends Object3D>(object: T): T {
    this.content.add(object);
    this.invalidate();
    return object;
  }

  /** Takes out and frees what was added. */
  remove(object: Object3D | null | undefined): void {
    if (!object) return;
    object.removeFromParent();
    if (this.fitted?.what === object) this.fitted = { ...this.fitted, what: null };
    dispose(object);
    this.invalidate();
  }

  /** Shows an object, a box, or all of the content, from the position of the camera. */
  fit(what: Object3D | Box3 = this.content): void {
    const box = "isBox3" in what ? what.clone() : new Box3().setFromObject(what);
    this.fitted = box.isEmpty() ? null : { what, box: box.clone() };
    this.look(box);
  }

  private look(box: Box3): void {
    if (box.isEmpty()) box.setFromCenterAndSize(this.controls.target, new Vector3(0.1, 0.1, 0.1));
    const centre = box.getCenter(new Vector3());
    const radius = Math.max(box.getSize(new Vector3()).length() / 2, 1e-4);
    const from = this.camera.position.clone().sub(this.controls.target);
    if (from.lengthSq() === 0) from.copy(directionOf("home", this.up));
    from.normalize();
    const fov_rad = (this.camera.fov * Math.PI) / 180;
    const distance = kMargin * Math.max(fitDistance(box, from, upOf(this.up), fov_rad, this.camera.aspect), radius);
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(from, distance);
    this.camera.near = distance / 200;
    this.camera.far = distance * 50;
    this.camera.updateProjectionMatrix();
    this.ground.place(box, this.up, radius);
    this.controls.update();
    this.invalidate();
  }

  /** Shows all from a side. */
  setView(name: ViewName): void {
    this.camera.position.copy(this.controls.target).add(directionOf(name, this.up));
    this.fit();
  }

  /** Rotates by angles in radians, or comes nearer by a factor below 1. */
  orbit(right_rad: number, up_rad: number, nearer = 1): void {
    this.fitted = null;
    const offset = this.camera.position.clone().sub(this.controls.target);
    const up = upOf(this.up);
    offset.applyAxisAngle(up, right_rad);
    const polar = offset.angleTo(up);
    const axis = new Vector3().crossVectors(up, offset).normalize();
    const next = Math.min(Math.PI - 0.01, Math.max(0.01, polar - up_rad));
    if (axis.lengthSq() > 0) offset.applyAxisAngle(axis, next - polar);
    this.camera.position.copy(this.controls.target).addScaledVector(offset, nearer);
    this.controls.update();
    this.invalidate();
  }

  /** Rays from the pointer; the function that it returns ends it. */
  onPointer(listener: PointerListener): () => void {
    return listenToPointer(this, listener);
  }

  /** Aims the raycaster at a position of the canvas, in CSS pixels of the window. */
  aim(clientX: number, clientY: number): Raycaster {
    const place = this.canvas.getBoundingClientRect();
    const at = new Vector2(((clientX - place.left) / place.width) * 2 - 1, 1 - ((clientY - place.top) / place.height) * 2);
    this.raycaster.setFromCamera(at, this.camera);
    const near_m = kNear_px * this.metresPerPixel();
    this.raycaster.params.Line.threshold = near_m;
    this.raycaster.params.Points.threshold = near_m;
    return this.raycaster;
  }

  /** Metres that one CSS pixel shows at the middle of the view. */
  metresPerPixel(): number {
    const distance = this.camera.position.distanceTo(this.controls.target);
    return (2 * distance * Math.tan((this.camera.fov * Math.PI) / 360)) / Math.max(1, this.canvas.clientHeight);
  }

  showAxes(shown: boolean): void {
    this.ground.showAxes(shown);
    this.invalidate();
  }

  /** Reads the colours of the theme again. */
  takeColours(): void {
    this.scene.background = new Color(themeColour("--view-back"));
    this.ground.takeColours();
    this.invalidate();
  }

  destroy(): void {
    cancelAnimationFrame(this.frame);
    this.frame = -1;
    this.observer.disconnect();
    this.controls.dispose();
    dispose(this.scene);
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private readonly draw = (): void => {
    this.frame = 0;
    const begun_ms = performance.now();
    if (!this.ease.due(begun_ms)) return this.invalidate();
    for (const prepare of this.beforeDraw) prepare();
    this.renderer.render(this.scene, this.camera);
    // The task after the frame: the page is free again.
    setTimeout(() => this.ease.drew(begun_ms, performance.now()));
  };

  private readonly resize = (): void => {
    const place = this.canvas.parentElement!;
    const width = Math.max(1, place.clientWidth);
    const height = Math.max(1, place.clientHeight);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    const fitted = this.fitted && boxOfFitted(this.fitted, this.content);
    if (fitted) this.look(fitted.clone());
    this.invalidate();
  };
}
