// What is drawn of the touch: device point, proxy, the pointer and its spring, and the forces by component.
import { BufferAttribute, BufferGeometry, Color, Group, Line, LineBasicMaterial, type Material, Mesh, type MeshStandardMaterial, type Object3D, Vector3 } from "three";
import { themeColour } from "../../plot/colours";
import { arrow, pointArrow, sphere } from "../../view3d/helpers";
import { springLine } from "./spring";
import type { FeelState, Vector } from "./feelStore";

/** The parts of the force, with the number of their colour. The legend and the plots have the same. */
export const FORCES = [
  { key: "contact", label: "contact", colour: 1 },
  { key: "texture", label: "texture", colour: 2 },
  { key: "friction", label: "friction", colour: 3 },
  { key: "out", label: "on the hand", colour: 4 },
] as const;

const kArrowOfScene = 0.6; // the length of the largest force that is allowed, of the scene's radius
const kTurns = 9;

export class ForceMarks {
  readonly object = new Group();
  private readonly point = sphere(1, 0xffffff);
  private readonly proxy = sphere(1, 0xffffff);
  private readonly target = sphere(1, 0xffffff);
  private readonly spring = new Line(new BufferGeometry(), new LineBasicMaterial());
  private readonly arrows = FORCES.map(() => arrow(0xffffff));
  private radius_m = 0.02;

  constructor() {
    this.object.add(this.point, this.proxy, this.target, this.spring, ...this.arrows);
    this.object.traverse((part) => void (part.raycast = () => undefined));
    for (const part of [this.point, this.proxy, this.target, this.spring] as Mesh[]) onTop(part);
    for (const one of this.arrows) one.traverse((part) => part instanceof Mesh && onTop(part));
    this.spring.geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * (4 * kTurns + 3)), 3));
    this.spring.frustumCulled = false;
    this.takeColours();
    this.hide();
  }

  /** Sizes for a scene of this radius. */
  size(radius_m: number): void {
    this.radius_m = radius_m;
    this.point.scale.setScalar(0.011 * radius_m);
    this.proxy.scale.setScalar(0.015 * radius_m);
    this.target.scale.setScalar(0.008 * radius_m);
  }

  takeColours(): void {
    colour(this.point, "--text-1");
    colour(this.proxy, "--accent");
    colour(this.target, "--text-2");
    this.spring.material.color = new Color(themeColour("--text-2"));
    this.arrows.forEach((one, index) => one.traverse((part) => part instanceof Mesh && colour(part, `--series-${FORCES[index]!.colour}`)));
  }

  hide(): void {
    this.object.visible = false;
  }

  /** The newest state; `target` where this window's pointer is, if it has one. */
  show(state: FeelState, target: Vector | null, most_N: number): void {
    this.object.visible = true;
    this.point.position.fromArray(state.point);
    this.proxy.position.fromArray(state.proxy);
    this.proxy.visible = state.touching;
    this.target.visible = this.spring.visible = target !== null;
    if (target) {
      this.target.position.fromArray(target);
      const positions = this.spring.geometry.getAttribute("position") as BufferAttribute;
      (positions.array as Float32Array).set(springLine(target, state.point, 0.012 * this.radius_m, kTurns));
      positions.needsUpdate = true;
    }
    const perNewton = (kArrowOfScene * this.radius_m) / Math.max(0.5, Math.min(most_N, 5) / 2);
    const from = new Vector3().fromArray(state.touching ? state.proxy : state.point);
    this.arrows.forEach((one, index) => {
      pointArrow(one, from, new Vector3().fromArray(state[FORCES[index]!.key]).multiplyScalar(perNewton));
    });
  }
}

/** Seen through the surface: the point is inside it while it presses. */
function onTop(part: Object3D): void {
  part.renderOrder = 2;
  const material = (part as Mesh).material as Material;
  material.depthTest = false;
  material.transparent = true;
}

function colour(part: Object3D, name: string): void {
  ((part as Mesh).material as MeshStandardMaterial).color = new Color(themeColour(name));
}
