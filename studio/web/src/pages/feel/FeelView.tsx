import { useEffect, useRef, useState } from "preact/hooks";
import { Box3, type Group, Vector3 } from "three";
import { dark } from "../../app/settings";
import type { Block } from "../../net/block";
import { seriesColour } from "../../plot/colours";
import { fixed, withUnit } from "../../ui/format";
import { project } from "../../state/project";
import { leaseIsOthers } from "../../state/lease";
import { Button } from "../../ui/Button";
import type { View } from "../../view3d/View";
import { Viewport } from "../../view3d/Viewport";
import { pointOf, type Target } from "./drag";
import type { TextureHead } from "./feelAreas";
import { followPointer } from "./feelPointer";
import { makeFeelScene } from "./feelScene";
import { feelSection } from "./feelChoices";
import { commandsRun, feelState, feelStatus, length3, takeRun } from "./feelStore";
import { FORCES, ForceMarks } from "./ForceMarks";
import { placeLetters, tileTops } from "./tileLetters";

export interface FeelViewProps {
  block: Block | null;
  depth_m: number;
  deepest_m: number;
  onDepth(depth_m: number): void;
  /** A trial of a study: seen from above, without values, and rendered only while a study is. */
  blind?: boolean;
}

const kHoverOfScene = 0.06;

/** The scene, the touch in it, and the pointer that pulls the device point. */
export function FeelView(props: FeelViewProps) {
  const view = useRef<View | null>(null);
  const surface = useRef<Group | null>(null);
  const marks = useRef<ForceMarks | null>(null);
  const target = useRef<Target | null>(null);
  const radius_m = useRef(0.02);
  const shape = useRef("");
  const letters = useRef<HTMLDivElement>(null);
  const tops_m = useRef<Vector3[]>([]);
  const [ready, setReady] = useState(0);
  const now = useRef(props);
  now.current = props;
  const { block, blind = false } = props;
  // While a block is fetched, the kind of the last one: another upward axis would end the view and the pointer's target.
  const flat = useRef((feelSection.value?.height_maps?.length ?? 0) > 0);
  if (block) flat.current = block.head.height_maps === true;
  const isOurs = () => feelStatus.value?.visited === blind;

  useEffect(() => {
    if (!view.current) return;
    view.current.remove(surface.current);
    surface.current = block ? view.current.add(makeFeelScene(block)) : null;
    tops_m.current = block && blind ? tileTops(block) : [];
    marks.current?.takeColours();
    if (!surface.current) return;
    const box = new Box3().setFromObject(surface.current);
    radius_m.current = Math.max(1e-4, box.getSize(new Vector3()).length() / 2);
    marks.current?.size(radius_m.current);
    const here = JSON.stringify([box.min, box.max]);
    if (here !== shape.current) view.current.fit(surface.current);
    if (here !== shape.current && blind) view.current.setView("top");
    shape.current = here;
  }, [block, dark.value, ready]);

  const state = feelState.value;
  useEffect(() => {
    if (!view.current || !marks.current) return;
    const most_N = feelStatus.value?.max_force_N ?? 5;
    // With motors the hand receives the force; a drawn one would be a second answer.
    if (state && isOurs() && !(blind && feelStatus.value?.real_forces)) marks.current.show(state, target.current && pointOf(target.current), most_N);
    else marks.current.hide();
    view.current.invalidate();
  }, [state, ready]);

  const isMouse = feelStatus.value?.device === "mouse" && commandsRun() && isOurs();
  return (
    <Viewport
      label={isMouse ? "The scene. The pointer touches it: press to touch, Page Down presses deeper, arrows move" : "The scene with its textured areas"}
      // Height maps lie in the plane of x and y.
      up={blind || flat.current ? "z" : project.value.up}
      views={!blind}
      testId="feel-view"
      onReady={(made) => {
        view.current = made;
        marks.current = new ForceMarks();
        // A rotated picture would have A at the right.
        made.controls.enableRotate = made.controls.enablePan = !blind;
        // A participant has left and right alone.
        made.showAxes(!blind);
        made.scene.add(marks.current.object);
        made.beforeDraw.add(() => placeLetters(letters.current, made, tops_m.current));
        setReady((count) => count + 1);
        const end = followPointer(made, {
          surface: () => surface.current,
          active: () => feelStatus.value?.device === "mouse" && commandsRun() && isOurs(),
          depth_m: () => now.current.depth_m,
          setDepth: (depth_m) => now.current.onDepth(depth_m),
          limits: () => ({ hover_m: kHoverOfScene * radius_m.current, deepest_m: now.current.deepest_m }),
          onTarget: (next) => void (target.current = next),
        });
        return () => {
          end();
          view.current = null;
          surface.current = null;
          marks.current = null;
          target.current = null;
          shape.current = "";
        };
      }}
    >
      {!blind && <Legend />}
      {blind && block && (
        <div ref={letters} class="feel-letters" aria-hidden="true" data-testid="feel-letters">
          {(block.head.textures as TextureHead[]).map(({ name }) => (
            <span key={name}>{name}</span>
          ))}
        </div>
      )}
      <NoForce />
    </Viewport>
  );
}

/** States that a run continues without force, and how to take it. */
function NoForce() {
  const status = feelStatus.value;
  if (status?.state !== "running" || !status.may_command_forces || commandsRun()) return null;
  return (
    <div class="feel-no-force" role="status" data-testid="feel-no-force">
      <p>{leaseIsOthers.value ? "Another window has the force. This one shows the run." : "This window does not have the force. The run continues, but no force reaches the hand."}</p>
      {!leaseIsOthers.value && (
        <Button kind="primary" onClick={takeRun}>
          Take the force
        </Button>
      )}
    </div>
  );
}

/** The forces by component, with their colour and number. */
function Legend() {
  void dark.value;
  const state = feelState.value;
  return (
    <ul class="feel-legend" aria-label="Forces in the view">
      {FORCES.map(({ key, label, colour }) => (
        <li key={key}>
          <svg width="22" height="10" viewBox="0 0 22 10" aria-hidden="true">
            <path d="M1 5h13M13 1.500 20 5l-7 3.500z" style={{ stroke: seriesColour(colour, 0), fill: seriesColour(colour, 0), strokeWidth: 2 }} />
          </svg>
          <span>{label}</span>
          <span class="numeric">{withUnit(state ? fixed(length3(state[key]), 2) : "–", "N")}</span>
        </li>
      ))}
    </ul>
  );
}
