import "uplot/dist/uPlot.min.css";
import { useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import { dark } from "../app/settings";
import { Legend } from "./Legend";
import { Drawing } from "./Drawing";
import { PlotSave } from "./PlotSave";
import type { PlotProps } from "./props";
import type { Range } from "./zoom";
import { summary } from "./summary";

/**
 * A plot that fills its place. Drag zooms, a double click shows all; with the focus + and − zoom, arrows move, 0 shows
 * all. Series of any length: only what can be seen is drawn.
 */
export function Plot(props: PlotProps) {
  const { series, legend = series.length > 1, empty = "Nothing to show yet." } = props;
  const place = useRef<HTMLDivElement>(null);
  const readout = useRef<HTMLDivElement>(null);
  const drawing = useRef<Drawing | null>(null);
  const kept = useRef<Range | null>(null);
  const newest = useRef(props);
  newest.current = props;
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
          <PlotSave plot={props} shown={shown} range={() => drawing.current?.shownRange() ?? null} />
          <div class="plot-over">
            <div ref={readout} class="plot-readout" aria-hidden="true" />
          </div>
          <div
            ref={place}
            class="plot-canvas"
            role="img"
            tabIndex={0}
            aria-label={`${props.label}. ${summary(props)} Keys: plus and minus zoom, arrows move, 0 shows all.`}
            onKeyDown={(event) => {
              if (event.ctrlKey || event.altKey || event.metaKey || !drawing.current?.key(event.key)) return;
              event.preventDefault();
              event.stopPropagation();
            }}
          />
        </>
      )}
    </div>
  );
}
