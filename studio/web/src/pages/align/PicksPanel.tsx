import { useState } from "preact/hooks";
import { call } from "../../net/connection";
import { edit } from "../../state/document";
import { Button } from "../../ui/Button";
import { length } from "../../ui/format";
import { IconButton } from "../../ui/IconButton";
import { NumberField } from "../../ui/NumberField";
import { Panel } from "../../ui/Panel";
import { Table } from "../../ui/Table";
import { say } from "../../ui/toast";
import { align, half, missing, placed, showing } from "./alignState";
import { toMesh, type Point } from "./pose";
import { pointWords } from "./picks";

/** Pairs of points, and the pose that lays them on each other. */
export function PicksPanel() {
  const picks = align.value?.picks ?? [];
  const pose = placed.value;
  const apart = (path: Point, mesh: Point): string => {
    if (!pose) return "–";
    const there = toMesh(pose, path);
    return length(Math.hypot(...there.map((value, axis) => value - mesh[axis]!)), 3);
  };
  const lacks = missing.value || (picks.length < 3 ? "Pick three pairs or more." : "");
  const lay = async () => {
    const { rms_m } = await call("align.pick");
    showing.value = "placed";
    say(`The picked points agree to ${length(rms_m, 3)} RMS.`);
  };
  const remove = (index: number) => edit("/align/picks", picks.filter((_, other) => other !== index), "remove a pair of points");
  return (
    <Panel title={`By points (${picks.length})`} collapsible testId="align-picks">
      {half.value && (
        <p class="field-hint">
          Pair {picks.length + 1} waits for its point on the mesh. <Button onClick={() => (half.value = null)}>Cancel pair</Button>
        </p>
      )}
      <Table
        caption="Pairs of picked points"
        columns={[
          { key: "number", label: "No.", cell: (_, index) => index + 1 },
          { key: "mesh", label: "On the mesh", cell: ({ mesh }) => pointWords(mesh) },
          { key: "apart", label: "Distance", numeric: true, cell: ({ path, mesh }) => apart(path, mesh) },
          {
            key: "remove",
            label: "Remove", unseen: true,
            cell: (_, index) => <IconButton icon="trash" label={`Remove pair ${index + 1}`} onClick={() => remove(index)} />,
          },
        ]}
        rows={picks}
        empty="Press Pick, click a point of the path, then its point on the mesh."
      />
      <div class="buttons">
        <Button kind="primary" onClick={lay} disabled={lacks !== ""} hint={lacks || undefined} testId="align-lay">
          Align pairs
        </Button>
        <Button onClick={() => edit("/align/picks", [], "remove all pairs")} disabled={picks.length === 0}>
          Remove all
        </Button>
      </div>
      <Coordinates />
    </Panel>
  );
}

const AXES = ["x", "y", "z"] as const;

/** A pair by its coordinates, for those who do not click. */
function Coordinates() {
  const [path, setPath] = useState<Point>([0, 0, 0]);
  const [mesh, setMesh] = useState<Point>([0, 0, 0]);
  const field = (of: string, point: Point, set: (next: Point) => void) =>
    AXES.map((axis, index) => (
      <NumberField
        key={`${of} ${axis}`}
        label={`${of} ${axis}`}
        value={point[index]!}
        factor={1e3}
        step={1e-4}
        unit="mm"
        onChange={(value) => set(point.map((old, other) => (other === index ? value : old)) as unknown as Point)}
      />
    ));
  const add = () => edit("/align/picks", [...(align.value?.picks ?? []), { path, mesh }], "add a pair of points");
  return (
    <details class="align-coordinates">
      <summary>A pair by its coordinates</summary>
      {field("Path", path, setPath)}
      {field("Mesh", mesh, setMesh)}
      <Button onClick={add} disabled={missing.value !== ""} hint={missing.value || undefined}>
        Add the pair
      </Button>
    </details>
  );
}
