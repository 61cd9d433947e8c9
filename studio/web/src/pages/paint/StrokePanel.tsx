import { useState } from "preact/hooks";
import { edit } from "../../state/document";
import { Button } from "../../ui/Button";
import { fixed, length } from "../../ui/format";
import { IconButton } from "../../ui/IconButton";
import { NumberField } from "../../ui/NumberField";
import { Panel } from "../../ui/Panel";
import { Table } from "../../ui/Table";
import { complain } from "../../ui/toast";
import type { PaintSection, Point, StrokeFigures } from "./painting";

const AXES = ["x", "y", "z"] as const;

/** The strokes, and the points of the chosen one as numbers: all that the mouse does can be typed. */
export function StrokePanel({ paint, figures, onBegin }: { paint: PaintSection; figures: StrokeFigures[]; onBegin(texture: string): Promise<void> }) {
  const [typed, setTyped] = useState<Point>([0, 0, 0]);
  const stroke = paint.strokes[paint.current];
  const picks = `/paint/strokes/${paint.current}/picks_m`;
  const take = (index: number) =>
    edit("/paint", { ...paint, strokes: paint.strokes.filter((_, at) => at !== index), current: -1 }, `remove stroke ${index + 1}`);

  return (
    <Panel
      title="Strokes"
      actions={
        <Button kind="quiet" disabled={!stroke} hint="With the texture of the chosen stroke" onClick={() => onBegin(stroke!.texture)}>
          New
        </Button>
      }
    >
      <Table
        caption="List of strokes"
        testId="paint-strokes"
        empty="None yet: choose a texture."
        rows={paint.strokes}
        chosen={(_, index) => index === paint.current}
        onChoose={(_, index) => edit("/paint/current", index, `choose stroke ${index + 1}`).catch(complain)}
        columns={[
          { key: "number", label: "No.", cell: (_, index) => index + 1, numeric: true },
          { key: "texture", label: "Texture", cell: (row) => row.texture.replace(/[./]texture\.json$/, "").replace(/^.*\//, "") },
          { key: "length", label: "Length", numeric: true, cell: (row, index) => (row.picks_m.length < 2 ? "–" : figures[index]?.fault ? "fault" : length(figures[index]?.path_length_m, 3)) },
          { key: "drop", label: "Remove", unseen: true, cell: (_, index) => <IconButton icon="trash" label={`Remove stroke ${index + 1}`} onClick={() => take(index)} /> },
        ]}
      />
      {stroke && stroke.picks_m.length >= 2 && figures[paint.current]?.fault && (
        <p class="field-error" role="alert">
          {figures[paint.current]!.fault}
        </p>
      )}
      {stroke && (
        <>
          <Table
            caption={`Points of stroke ${paint.current + 1}`}
            testId="paint-points"
            empty="No points yet."
            rows={stroke.picks_m}
            columns={[
              ...AXES.map((axis, at) => ({ key: axis, label: axis, unit: "mm", numeric: true, cell: (row: Point) => fixed(row[at]! * 1e3, 2) })),
              {
                key: "drop",
                label: "Remove", unseen: true,
                cell: (_: Point, index: number) => (
                  <IconButton icon="trash" label={`Remove point ${index + 1}`} onClick={() => edit(picks, stroke.picks_m.filter((_, at) => at !== index), "remove a point")} />
                ),
              },
            ]}
          />
          <fieldset class="paint-typed">
            <legend>Add a point by its coordinates; the nearest point of the surface is used</legend>
            <div>
              {AXES.map((axis, at) => (
                <NumberField key={axis} label={`${axis} / mm`} value={typed[at]!} factor={1e3} testId={`paint-${axis}`}
                  onChange={(value) => setTyped(typed.map((old, index) => (index === at ? value : old)) as Point)} />
              ))}
            </div>
            <Button onClick={() => edit(picks, [...stroke.picks_m, typed], "add a point")} testId="paint-add">
              Add point
            </Button>
          </fieldset>
        </>
      )}
    </Panel>
  );
}
