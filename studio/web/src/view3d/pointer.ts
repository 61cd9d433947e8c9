import type { Intersection, Object3D, Ray, Raycaster } from "three";

export interface PointerHit {
  kind: "down" | "move" | "up" | "leave";
  event: PointerEvent;
  /** Through the pointer, in the world of the view. */
  ray: Ray;
  /** The nearest thing hit among `targets`, or null. */
  hit: Intersection<Object3D> | null;
}

export interface PointerListener {
  /** What can be hit; all of the content without it. */
  targets?(): Object3D[];
  /** Returns true to have the pointer for itself: the view does not rotate until it is up. */
  on(pointer: PointerHit): boolean | void;
}

/** What listenToPointer asks of a view. */
export interface PointedView {
  readonly canvas: HTMLCanvasElement;
  readonly controls: { enabled: boolean };
  readonly content: Object3D;
  /** A ray through a position of the canvas, in CSS pixels of the window. */
  aim(clientX: number, clientY: number): Raycaster;
}

/** Calls the listener for what the pointer does over the view; the function that it returns ends it. */
export function listenToPointer(view: PointedView, { targets, on }: PointerListener): () => void {
  const { canvas, controls } = view;
  const tell = (kind: PointerHit["kind"], event: PointerEvent): boolean => {
    const raycaster = view.aim(event.clientX, event.clientY);
    const hits = kind === "leave" ? [] : raycaster.intersectObjects(targets?.() ?? [view.content], true);
    return on({ kind, event, ray: raycaster.ray, hit: hits[0] ?? null }) === true;
  };
  const down = (event: PointerEvent) => {
    if (!tell("down", event)) return;
    controls.enabled = false;
    canvas.setPointerCapture(event.pointerId);
    event.stopImmediatePropagation();
  };
  const move = (event: PointerEvent) => void tell("move", event);
  const up = (event: PointerEvent) => {
    controls.enabled = true;
    tell("up", event);
  };
  const leave = (event: PointerEvent) => void tell("leave", event);
  canvas.addEventListener("pointerdown", down, { capture: true });
  canvas.addEventListener("pointermove", move);
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener("pointerleave", leave);
  return () => {
    canvas.removeEventListener("pointerdown", down, { capture: true });
    canvas.removeEventListener("pointermove", move);
    canvas.removeEventListener("pointerup", up);
    canvas.removeEventListener("pointercancel", up);
    canvas.removeEventListener("pointerleave", leave);
  };
}
