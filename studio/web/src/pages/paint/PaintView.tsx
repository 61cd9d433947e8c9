import { useEffect, useRef, useState } from "preact/hooks";
import type { LineLoop, Mesh, Object3D, Vector3 } from "three";
import type { Block } from "../../net/block";
import { dark } from "../../app/settings";
import { themeColour } from "../../plot/colours";
import { lineFromPoints, sphere } from "../../view3d/helpers";
import { project } from "../../state/project";
import { Viewport } from "../../view3d/Viewport";
import type { View } from "../../view3d/View";
import { aim, extended, ring, spacing_m } from "./brush";
import { colourPaintedMesh, makePaintedMesh, type PaintedMesh } from "./paintedMesh";
import type { Point, Show, Stroke } from "./painting";

export interface Hover {
  texture: number;
  stretch: number;
  folded: boolean;
  /** Where the pointer is on the texture, mm. */
  xy_mm: [number, number] | null;
}

export interface PaintViewProps {
  block: Block | null;
  strokes: readonly Stroke[];
  current: number;
  show: Show;
  cell_mm: number;
  drawing: boolean;
  /** A drag draws, where it rotates the view otherwise. */
  brush: boolean;
  half_width_mm: number;
  /** The points of a drag, at its end. */
  onBrush(points: readonly Point[]): void;
  onPick(point: Point): void;
  onMove(pick: number, point: Point, first: boolean): void;
  onHover(hover: Hover | null): void;
}

/** The mesh with its textures, the strokes' paths and their points; a click on the mesh adds a point while drawing. */
export function PaintView(props: PaintViewProps) {
  const view = useRef<View | null>(null);
  const mesh = useRef<PaintedMesh | null>(null);
  const marks = useRef<Object3D[]>([]);
  const balls = useRef<Mesh[]>([]);
  const object = useRef("");
  const [ready, setReady] = useState(0);
  const now = useRef(props);
  now.current = props;
  const { block, strokes, current, show, cell_mm } = props;

  useEffect(() => {
    if (!view.current) return;
    view.current.remove(mesh.current);
    mesh.current = null;
    if (!block) return;
    mesh.current = makePaintedMesh(block);
    colourPaintedMesh(mesh.current, block, show, cell_mm);
    view.current.add(mesh.current);
    const shape = JSON.stringify([block.head.low_m, block.head.high_m]);
    if (shape !== object.current) view.current.fit(mesh.current);
    object.current = shape;
  }, [block, ready]);

  useEffect(() => {
    if (!mesh.current || !block) return;
    colourPaintedMesh(mesh.current, block, show, cell_mm);
    view.current?.invalidate();
  }, [show, cell_mm, dark.value]);

  useEffect(() => {
    if (!view.current) return;
    for (const mark of marks.current) view.current.remove(mark);
    marks.current = [];
    balls.current = [];
    if (!block) return;
    const size = block.head.high_m.map((high: number, axis: number) => high - block.head.low_m[axis]) as Point;
    const radius = 0.006 * Math.hypot(...size);
    strokes.forEach((stroke, index) => {
      const chosen = index === current;
      const path = block.arrays[`path_${index}`];
      const colour = themeColour(chosen ? "--accent" : "--text-2");
      if (path) marks.current.push(view.current!.add(lineFromPoints(path, colour)));
      if (!chosen) return;
      for (const pick of stroke.picks_m) {
        const ball = sphere(radius, colour);
        ball.position.set(...pick);
        balls.current.push(ball);
        marks.current.push(view.current!.add(ball));
      }
    });
  }, [block, strokes, current, dark.value, ready]);

  return (
    <Viewport
      label="The mesh with its textures and strokes"
      up={project.value.up}
      testId="paint-view"
      onReady={(made) => {
        view.current = made;
        setReady((count) => count + 1);
        const end = listen(made, () => now.current, () => mesh.current, () => balls.current);
        return () => {
          end();
          view.current = null;
          mesh.current = null;
          object.current = "";
        };
      }}
    >
      {!block && <p class="viewport-empty">Choose a mesh or a scene at the left, then a texture to start a stroke.</p>}
    </Viewport>
  );
}

const kClick_px = 4;

function listen(view: View, props: () => PaintViewProps, mesh: () => PaintedMesh | null, balls: () => Mesh[]): () => void {
  let down: { x: number; y: number } | null = null;
  let moved = -1;
  let first = false;
  let brushed: readonly Point[] = [];
  let circle: LineLoop | null = null;
  const trail: Object3D[] = [];
  const clear = () => trail.splice(0).forEach((one) => view.remove(one));
  const showRing = (point: Point | null, normal: Vector3 | undefined) => {
    if (circle) view.remove(circle);
    circle = null;
    const { drawing, half_width_mm } = props();
    if (!point || !normal || !drawing || half_width_mm <= 0) return;
    circle = ring(themeColour("--accent"));
    aim(circle, point, normal, half_width_mm * 1e-3);
    view.add(circle);
  };
  const follow = (point: Point) => {
    const { block, half_width_mm } = props();
    if (!block) return;
    const size_m = Math.hypot(...(block.head.high_m as number[]).map((high, axis) => high - block.head.low_m[axis]));
    const next = extended(brushed, point, spacing_m(half_width_mm, size_m));
    if (next === brushed) return;
    brushed = next;
    const ball = sphere(0.004 * size_m, themeColour("--accent"));
    ball.position.set(...point);
    trail.push(view.add(ball));
  };
  const targets = () => (mesh() ? [mesh()!] : []);
  return view.onPointer({
    targets,
    on({ kind, event, hit }) {
      const { drawing, onPick, onMove, onHover } = props();
      const point = hit && (hit.point.toArray() as Point);
      if (kind === "down" && event.button === 0) {
        down = { x: event.clientX, y: event.clientY };
        const ball = drawing ? view.raycaster.intersectObjects(balls(), false)[0] : undefined;
        moved = ball ? balls().indexOf(ball.object as Mesh) : -1;
        first = true;
        if (moved < 0 && drawing && props().brush && point) {
          follow(point);
          return true;
        }
        return moved >= 0;
      }
      if (kind === "move" || kind === "leave") showRing(point, hit?.face?.normal);
      if (kind === "move" && brushed.length > 0 && point) follow(point);
      if (kind === "move" && moved >= 0 && point) {
        onMove(moved, point, first);
        first = false;
      } else if (kind === "move") onHover(hoverAt(props().block, hit?.faceIndex ?? -1, hit?.uv ?? null, props().cell_mm));
      if (kind === "leave") onHover(null);
      if (kind !== "up") return;
      if (brushed.length > 0) {
        if (drawing && mesh()) props().onBrush(brushed);
        brushed = [];
        down = null;
        return clear();
      }
      const isClick = down && Math.hypot(event.clientX - down.x, event.clientY - down.y) < kClick_px;
      if (isClick && moved < 0 && drawing && point) onPick(point);
      down = null;
      moved = -1;
    },
  });
}

function hoverAt(block: Block | null, triangle: number, uv: { x: number; y: number } | null, cell_mm: number): Hover | null {
  if (!block || triangle < 0) return null;
  const texture = block.arrays.texture![triangle] ?? -1;
  return {
    texture,
    stretch: block.arrays.stretch![triangle] ?? NaN,
    folded: block.arrays.folded![triangle] === 1,
    xy_mm: texture < 0 || !uv ? null : [uv.x * 2 * cell_mm, uv.y * 2 * cell_mm],
  };
}
