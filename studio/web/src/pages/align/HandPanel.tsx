import { Panel } from "../../ui/Panel";
import { Slider } from "../../ui/Slider";
import { Button } from "../../ui/Button";
import { Select } from "../../ui/Select";
import { edit } from "../../state/document";
import { about, align, missing, moveBySix, opened, shownSix, turnAbout, type Six } from "./alignState";

const AXES = ["x", "y", "z"] as const;
// Rotations about x, the rotated y and the twice rotated z; the middle one within 90°, so that the six are one pose.
const TURN_LIMITS_deg = [180, 90, 180];
const kOriginReach_m = 1;

/** The six numbers of the pose (thesis §5.4, Fig. 23). */
export function HandPanel() {
  const six = shownSix.value;
  const head = opened.value?.head;
  const set = (which: keyof Six, axis: number, value: number, gesture: string): void => {
    if (!six) return;
    const numbers = [...six[which]];
    numbers[axis] = value;
    moveBySix({ ...six, [which]: numbers }, gesture);
  };
  return (
    <Panel title="By hand" collapsible testId="align-hand">
      <Select
        label="Rotate about"
        value={about.value}
        options={[
          { value: "middle", label: "the path's centre" },
          { value: "origin", label: "the world's origin" },
        ]}
        wide
        hint={about.value === "middle" ? "x, y, z: position of the path's centre in the mesh's frame" : "The six numbers of asperity register --align"}
        onChange={(what) => turnAbout(what as "middle" | "origin")}
        testId="align-about"
      />
      {AXES.map((axis, index) => {
        const value = six?.shift_m[index] ?? 0;
        const [low, high] = range(head, index, value);
        return (
          <Slider
            key={axis}
            label={axis}
            value={rounded(value, 1e-6)}
            low={low}
            high={high}
            step={1e-4}
            factor={1e3}
            unit="mm"
            disabled={!six || missing.value !== ""}
            onInput={(next, gesture) => set("shift_m", index, next, gesture)}
            testId={`align-shift-${axis}`}
          />
        );
      })}
      {AXES.map((axis, index) => (
        <Slider
          key={axis}
          label={`rotate ${axis}`}
          value={rounded(six?.turn_deg[index] ?? 0, 0.01)}
          low={-TURN_LIMITS_deg[index]!}
          high={TURN_LIMITS_deg[index]!}
          step={0.1}
          unit="°"
          disabled={!six || missing.value !== ""}
          onInput={(next, gesture) => set("turn_deg", index, next, gesture)}
          testId={`align-turn-${axis}`}
        />
      ))}
      <Button
        onClick={() => edit("/align/T_mesh_world", null, "reset the pose")}
        disabled={missing.value !== "" || !align.value?.T_mesh_world}
        hint={missing.value || "Moves the path's centre to that of the mesh, without rotation"}
      >
        Reset pose
      </Button>
    </Panel>
  );
}

/** As it is shown; what is not touched keeps its digits. */
const rounded = (value: number, step: number): number => Number((Math.round(value / step) * step).toPrecision(12));

/** Half a mesh beyond the mesh; about the world's origin, the reach of a tracker. */
function range(head: Record<string, any> | undefined, axis: number, value: number): [number, number] {
  if (!head || about.value === "origin") {
    const reach = Math.max(kOriginReach_m, Math.ceil(2 * Math.abs(value)));
    return [-reach, reach];
  }
  const low = head.low_m[axis] as number;
  const high = head.high_m[axis] as number;
  const beyond = 0.5 * Math.hypot(...[0, 1, 2].map((k) => head.high_m[k] - head.low_m[k]));
  return [Math.min(low - beyond, value), Math.max(high + beyond, value)];
}
