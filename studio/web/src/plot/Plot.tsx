import "uplot/dist/uPlot.min.css";
import { useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import { dark } from "../app/settings";
import { IconButton } from "../ui/IconButton";
import { cursorsOf } from "./linked";
import type { CursorName } from "./cursors";
import { firstCursors, measured, placed, stepped } from "./measure";
import { Legend } from "./Legend";
import { Drawing } from "./Drawing";
import { PlotSave } from "./PlotSave";
import type { PlotProps } from "./props";
import type { Range } from "./zoom";
import { summary } from "./summary";

/**
 * A plot that fills its container. Drag zooms, a double click shows all; with the focus + and − zoom, arrows move, 0 shows
 * all, m shows two measuring cursors. Series of any length: only what can be seen is drawn.
 */
export function Plot(props: PlotProps) {
  const { series, legend = series.length > 1, empty = "Nothing to show yet." } = props;
  const place = useRef<HTMLDivElement>(null);
  const readout = useRef<HTMLDivElement>(null);
  const drawing = useRef<Drawing | null>(null);
  const kept = useRef<Range | null>(null);
  const newest = useRef(props);
  const cursors = useMemo(() => cursorsOf(props.syncKey), [props.syncKey]);
  const chosen = useRef<CursorName>("a");
  const placeCursor = (x: number) => {
    if (cursors.value) cursors.value = placed(cursors.value, x);
    else props.onPick?.(x);
  };
  newest.current = { ...props, cursors: cursors.value, onPick: placeCursor };
  const [hidden, setHidden] = useState<ReadonlySet<string>>(new Set());

  const isEmpty = series.every((one) => one.y.length === 0);
  const shape = series.map((one) => [one.label, one.kind, one.colour, one.dashed, one.width, one.hidden || hidden.has(one.label), !!one.lo].join()).join("|");
  const looks = [shape, props.logX, props.logY, props.syncKey, props.xAxis.label, props.xAxis.unit, props.yAxis.label, props.yAxis.unit].join("|");
  const shown = useMemo(() => series.map((one) => (hidden.has(one.label) ? { ...one, hidden: true } : one)), [series, hidden]);

  // Drawn with the same frame as the rest of the page.
  useLayoutEffect(() => {
    if (isEmpty || !place.current) return;
    const made = new Drawing(place.current, () => newest.current, shown, (words) => (readout.current!.textContent = words), kept.current);
    drawing.current = made;
    return () => {
      kept.current = made.zoomedInto();
      drawing.current = null;
      made.destroy();
    };
  }, [looks, dark.value, isEmpty]);
  useLayoutEffect(() => drawing.current?.setSeries(shown), [shown, props.x, props.yRange?.[0], props.yRange?.[1], props.marks]);

  useLayoutEffect(() => drawing.current?.redraw(), [cursors.value]);

  const toggleCursors = () => {
    const range = drawing.current?.shownRange();
    cursors.value = cursors.value || !range ? null : firstCursors(range, props.logX ?? false);
  };
  const onKey = ({ key, shiftKey }: KeyboardEvent): boolean => {
    const range = drawing.current?.shownRange();
    if (!range) return false;
    if (key === "m") toggleCursors();
    else if (cursors.value && (key === "a" || key === "b")) chosen.current = key;
    else if (cursors.value && shiftKey && key.startsWith("Arrow")) cursors.value = stepped(cursors.value, chosen.current, key === "ArrowLeft" || key === "ArrowDown" ? -1 : 1, range);
    else return drawing.current!.key(key);
    return true;
  };

  return (
    <div class="plot" data-testid={props.testId}>
      {legend && (
        <Legend
          series={series}
          hidden={hidden}
          onToggle={(label) => setHidden(new Set(hidden.has(label) ? [...hidden].filter((one) => one !== label) : [...hidden, label]))}
        />
      )}
      {isEmpty ? (
        <p class="plot-empty empty">{empty}</p>
      ) : (
        <>
          <div class="plot-tools">
            <IconButton icon="ruler" label="Measure between two points" pressed={cursors.value !== null} onClick={toggleCursors} testId={props.testId && `${props.testId}-measure`} />
            <PlotSave plot={props} shown={shown} range={() => drawing.current?.shownRange() ?? null} />
          </div>
          {cursors.value && (
            <p class="plot-measured" role="status" title="Click: moves the nearer cursor. Keys: A and B choose a cursor, Shift and arrows move it." data-testid={props.testId && `${props.testId}-measured`}>
              {measured(props, shown, cursors.value)}
            </p>
          )}
          <div class="plot-over">
            <div ref={readout} class="plot-readout" aria-hidden="true" />
          </div>
          <div
            ref={place}
            class="plot-canvas"
            role="img"
            tabIndex={0}
            aria-label={`${props.label}. ${summary(props)} Keys: plus and minus zoom, arrows move, 0 shows all, M measures.`}
            onKeyDown={(event) => {
              if (event.ctrlKey || event.altKey || event.metaKey || !onKey(event)) return;
              event.preventDefault();
              event.stopPropagation();
            }}
          />
        </>
      )}
    </div>
  );
}
