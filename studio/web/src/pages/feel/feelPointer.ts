// The pointer, pen or keys over the 3D view, as the target that pulls the device point.
import { MOUSE, type Object3D, Vector3 } from "three";
import { sendPointer } from "../../net/connection";
import type { View } from "../../view3d/View";
import { alongSurface, onPlane, pointOf, pressDepth, raised, type Point, type PressLimits, type Target } from "./drag";

export interface FeelPointerProps {
  surface(): Object3D | null;
  /** This window has the force, and the mouse is the device. */
  active(): boolean;
  depth_m(): number;
  setDepth(depth_m: number): void;
  limits(): PressLimits;
  onTarget(target: Target | null): void;
}

const kNews_ms = 16;
const kWheelStep = 0.05; // of the deepest, for a notch
const kKeyStep = 0.01; // of the distance from which one looks

/** Follows pointer and keys; the function that it returns ends it. */
export function followPointer(view: View, props: FeelPointerProps): () => void {
  let target: Target | null = null;
  let pressing = false;
  const usual = { ...view.controls.mouseButtons };

  const take = (next: Target | null) => {
    target = next;
    props.onTarget(next);
  };
  const send = () => {
    const active = props.active();
    // The left button touches; the view is rotated by the right one meanwhile.
    view.controls.mouseButtons = active ? { LEFT: null, MIDDLE: MOUSE.PAN, RIGHT: MOUSE.ROTATE } : usual;
    if (!active) {
      // A user who takes the force again does not press at once.
      if (target) target = { ...target, height_m: Math.max(target.height_m, props.limits().hover_m) };
      props.onTarget(null);
      pressing = false;
      return;
    }
    if (!target) take(middleOf(view, props));
    if (target) sendPointer(...pointOf(target));
  };
  // By a timer: where pictures are slow (WebGL without a graphics card) frames come too seldom for the watchdog.
  const timer = window.setInterval(send, kNews_ms);

  const heightOf = (event: PointerEvent): number =>
    pressing || event.shiftKey ? -pressDepth(props.depth_m(), event.pointerType, event.pressure) : props.limits().hover_m;

  const endPointer = view.onPointer({
    targets: () => [props.surface()].filter((one): one is Object3D => one !== null),
    on({ kind, event, ray, hit }) {
      if (!props.active() || event.buttons > 1 || kind === "leave") return;
      if (kind === "down") pressing = event.button === 0;
      if (kind === "move") pressing = (event.buttons & 1) === 1;
      if (kind === "up") pressing = false;
      const seen = { origin: ray.origin.toArray() as Point, direction: ray.direction.toArray() as Point };
      if (hit?.face) {
        const normal = hit.face.normal.clone().transformDirection(hit.object.matrixWorld);
        if (normal.dot(ray.direction) > 0) normal.negate();
        take({ place: hit.point.toArray() as Point, normal: normal.toArray() as Point, height_m: heightOf(event) });
      } else if (target) {
        const place = onPlane(seen, target.place, target.normal);
        if (place) take({ ...target, place, height_m: heightOf(event) });
      }
      return kind === "down" && event.button === 0;
    },
  });

  const wheel = (event: WheelEvent) => {
    if (!props.active() || !(pressing || event.shiftKey)) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    const { deepest_m } = props.limits();
    const notch = Math.sign(event.deltaY || event.deltaX);
    const depth_m = Math.min(deepest_m, Math.max(0, props.depth_m() + notch * kWheelStep * deepest_m));
    props.setDepth(depth_m);
    if (target) take({ ...target, height_m: -depth_m });
  };

  const keys = (event: KeyboardEvent) => {
    if (!props.active() || !target || event.ctrlKey || event.altKey || event.metaKey) return;
    const next = moved(view, target, props, event.key, event.shiftKey ? 5 : 1);
    if (!next) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    take(next);
  };

  view.canvas.addEventListener("wheel", wheel, { capture: true, passive: false });
  view.canvas.addEventListener("keydown", keys, { capture: true });
  return () => {
    window.clearInterval(timer);
    endPointer();
    view.controls.mouseButtons = usual;
    view.canvas.removeEventListener("wheel", wheel, { capture: true });
    view.canvas.removeEventListener("keydown", keys, { capture: true });
  };
}

/** Over what is in the middle of the picture. */
function middleOf(view: View, props: FeelPointerProps): Target | null {
  const place = view.canvas.getBoundingClientRect();
  return landed(view, props, () => view.aim(place.left + place.width / 2, place.top + place.height / 2), props.limits().hover_m);
}

function landed(view: View, props: FeelPointerProps, aim: () => void, height_m: number): Target | null {
  const surface = props.surface();
  if (!surface) return null;
  aim();
  const hit = view.raycaster.intersectObject(surface, true).find((one) => one.face);
  if (!hit?.face) return null;
  const normal = hit.face.normal.clone().transformDirection(hit.object.matrixWorld);
  if (normal.dot(view.raycaster.ray.direction) > 0) normal.negate();
  return { place: hit.point.toArray() as Point, normal: normal.toArray() as Point, height_m };
}

/** After a key: arrows along the surface as they look, page up and down off it and into it. */
function moved(view: View, target: Target, props: FeelPointerProps, key: string, times: number): Target | null {
  const { hover_m, deepest_m } = props.limits();
  const press_m = (deepest_m / 25) * times;
  if (key === "PageDown") return { ...target, height_m: raised(target.height_m, -press_m, { hover_m, deepest_m }) };
  if (key === "PageUp") return { ...target, height_m: raised(target.height_m, press_m, { hover_m, deepest_m }) };
  const right = new Vector3().setFromMatrixColumn(view.camera.matrixWorld, 0).toArray() as Point;
  const up = new Vector3().setFromMatrixColumn(view.camera.matrixWorld, 1).toArray() as Point;
  const away = view.camera.getWorldDirection(new Vector3()).toArray() as Point;
  const wishes: Record<string, [Point, Point, number]> = {
    ArrowRight: [right, up, 1],
    ArrowLeft: [right, up, -1],
    ArrowUp: [up, away, 1],
    ArrowDown: [up, away, -1],
  };
  const wish = wishes[key];
  if (!wish) return null;
  const distance_m = view.camera.position.distanceTo(view.controls.target);
  const step_m = kKeyStep * distance_m * times * wish[2];
  const along = alongSurface(wish[0], target.normal, wish[1]);
  const place = new Vector3().fromArray(target.place).addScaledVector(new Vector3().fromArray(along), step_m);
  // Down onto the surface again, from a little above it.
  const normal = new Vector3().fromArray(target.normal);
  const above = place.clone().addScaledVector(normal, 5 * Math.abs(step_m));
  const next = landed(view, props, () => view.raycaster.set(above, normal.clone().negate()), target.height_m);
  return next ?? { ...target, place: place.toArray() as Point };
}
