import { useEffect, useRef, useState } from "preact/hooks";
import { dark } from "../../app/settings";
import { edit } from "../../state/document";
import { fixed } from "../../ui/format";
import { attempt, Button } from "../../ui/Button";
import { useKeys } from "../../ui/keys";
import type { View } from "../../view3d/View";
import { viewNames } from "../../view3d/views";
import { project } from "../../state/project";
import { Viewport } from "../../view3d/Viewport";
import { AlignScene } from "./AlignScene";
import { align, colouring, ghostPose, half, iterations, missing, move, opened, residuals, scrub, showAreas, showing, showOverlaps, shown, shownPoses, take, tool } from "./alignState";
import type { Tool } from "./alignState";
import { DistanceLegend } from "./DistanceLegend";
import { phaseWords } from "./iterations";
import { colourLimit_m, colourLimitSigmas, inSigmas } from "./residuals";

const kClick_px = 4;

/** Mesh and path, coloured by their distance, with the gizmo and the picked points. */
export function AlignView() {
  const view = useRef<View | null>(null);
  const scene = useRef<AlignScene | null>(null);
  const [translucent, setTranslucent] = useState(false);
  const [ready, setReady] = useState(0);
  const block = opened.value;
  const distances = residuals.value;

  useEffect(() => {
    if (!view.current || !block) return;
    const made = new AlignScene(view.current, block, { moved: move });
    scene.current = made;
    if (shown.value) made.place(shown.value);
    made.fit();
    return () => {
      scene.current = null;
      made.destroy();
    };
  }, [block, ready]);
  useEffect(() => void (shown.value && scene.current?.place(shown.value, shownPoses.value)), [block, ready, shown.value, shownPoses.value]);
  useEffect(() => scene.current?.placeGhost(ghostPose.value), [block, ready, ghostPose.value]);
  const by = colouring.value;
  useEffect(() => {
    if (by === "scan") scene.current?.colourByScan();
    else if (distances && by === "distance") scene.current?.colour(distances.distance_m, colourLimit_m(distances.distance_m));
    else if (distances) {
      const sigmas = inSigmas(distances.distance_m, distances.sigma_m);
      scene.current?.colour(sigmas, colourLimitSigmas(sigmas));
    }
  }, [block, ready, distances, by, dark.value]);
  useEffect(() => scene.current?.markOverlaps(showOverlaps.value && distances ? distances.overlap : null), [block, ready, distances, showOverlaps.value, dark.value]);
  useEffect(() => scene.current?.mark(align.value?.picks ?? [], half.value), [block, ready, align.value?.picks, half.value, dark.value]);
  useEffect(() => scene.current?.setTranslucent(translucent), [block, ready, translucent]);
  useEffect(() => scene.current?.takeColours(), [block, ready, dark.value]);
  useEffect(() => scene.current?.showAreas(showAreas.value), [block, ready, showAreas.value]);
  const gizmo = showing.value === "placed" && (tool.value === "translate" || tool.value === "rotate") ? tool.value : null;
  useEffect(() => scene.current?.setTool(gizmo), [block, ready, gizmo]);

  useKeys([
    { key: "t", label: "move the path with the gizmo", run: () => choose("translate") },
    { key: "r", label: "rotate the path with the gizmo", run: () => choose("rotate") },
    { key: "p", label: "pick pairs of points", run: () => choose("pick") },
    { key: "escape", label: "deselect the tool", run: () => (half.value ? (half.value = null) : choose("look")) },
    ...viewNames.map((name, index) => ({ key: `${index + 1}`, label: `view from the ${name}`, run: () => view.current?.setView(name) })),
  ]);

  return (
    <>
      <div class="align-tools" role="group" aria-label="Tools">
        <ToolButton name="look" words="Look" hint="Drag rotates the view (Esc)" />
        <ToolButton name="translate" words="Move" hint="Arrows move the path (T)" />
        <ToolButton name="rotate" words="Rotate" hint="Rings rotate the path about its centre (R)" />
        <ToolButton name="pick" words="Pick" hint="Click a point of the path, then its point on the mesh (P)" />
        <Button pressed={translucent} onClick={() => setTranslucent(!translucent)} hint="See the path through the mesh">
          See through
        </Button>
      </div>
      <Viewport
        label="The mesh and the scan path, coloured by its distance to the mesh"
        up={project.value.up}
        testId="align-view"
        onReady={(made) => {
          view.current = made;
          setReady((times) => times + 1);
          const end = listenToClicks(made, () => scene.current);
          return () => {
            end();
            scene.current?.destroy();
            scene.current = null;
            view.current = null;
          };
        }}
      >
        {distances && <DistanceLegend distances={distances} />}
        <Notice />
      </Viewport>
    </>
  );
}

function choose(next: Tool): void {
  if (missing.value && next !== "look") return;
  tool.value = next;
  if (next !== "pick") half.value = null;
  if (next !== "look") showing.value = "placed";
}

function ToolButton({ name, words, hint }: { name: Tool; words: string; hint: string }) {
  return (
    <Button pressed={tool.value === name} onClick={() => choose(name)} hint={missing.value || hint} disabled={missing.value !== ""} testId={`align-tool-${name}`}>
      {words}
    </Button>
  );
}

/** The label of what is shown, if it is not the path at its own pose. */
function Notice() {
  const words = noticeWords();
  return (
    <div class="align-notice" role="status">
      {words && <span>{words}</span>}
      {(showing.value === "best" || showing.value === "runner_up") && (
        <>
          <Button kind="primary" onClick={() => take(showing.value as "best" | "runner_up")}>
            Accept this pose
          </Button>
          <Button onClick={() => (showing.value = "placed")}>Back</Button>
        </>
      )}
    </div>
  );
}

function noticeWords(): string {
  if (missing.value) return missing.value;
  const { phases, phase, poses, rms_m } = iterations.value;
  switch (showing.value) {
    case "best":
      return "Shown: the registered pose, not accepted yet.";
    case "runner_up":
      return "Shown: the runner-up, not accepted yet.";
    case "iteration":
      if (poses.length === 0) return "Registering …";
      return [
        `Iteration ${scrub.value + 1} of ${poses.length}`,
        `${phaseWords(phases[phase[scrub.value]!] ?? "")}, ${fixed(1e3 * (rms_m[scrub.value] ?? NaN), 3)}\u202fmm RMS`,
      ].join(": ");
    case "placed":
      if (tool.value !== "pick") return "";
      return half.value ? "Now click the same point on the mesh." : "Click a point of the path.";
  }
}

/** A click, which is not a drag, picks a point of the path and then one of the mesh. */
function listenToClicks(view: View, scene: () => AlignScene | null): () => void {
  let down: { x: number; y: number } | null = null;
  return view.onPointer({
    targets: () => [],
    on({ kind, event }) {
      if (kind === "down" && event.button === 0) down = { x: event.clientX, y: event.clientY };
      if (kind !== "up" || !down) return;
      const isClick = Math.hypot(event.clientX - down.x, event.clientY - down.y) < kClick_px;
      down = null;
      if (isClick && tool.value === "pick") pickAt(event.clientX, event.clientY, scene());
    },
  });
}

function pickAt(x: number, y: number, scene: AlignScene | null): void {
  if (!scene) return;
  if (!half.value) {
    half.value = scene.pathPointAt(x, y);
    return;
  }
  const mesh = scene.meshPointAt(x, y);
  if (!mesh) return;
  const picks = [...(align.value?.picks ?? []), { path: half.value, mesh }];
  half.value = null;
  void attempt(() => edit("/align/picks", picks, "pick a pair of points"));
}
