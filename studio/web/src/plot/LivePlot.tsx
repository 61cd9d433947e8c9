import "uplot/dist/uPlot.min.css";
import uPlot from "uplot";
import { useEffect, useRef } from "preact/hooks";
import { dark } from "../app/settings";
import { Legend } from "./Legend";
import type { LiveBuffer } from "./LiveBuffer";
import { Pace } from "./pace";
import { axis, axisWords, uSeries, type AxisWords } from "./options";
import type { Series } from "./series";

export interface LivePlotProps {
  label: string;
  /** Filled by its owner with append(); drawn when the screen is. */
  buffer: LiveBuffer;
  series: readonly Pick<Series, "label" | "colour" | "dashed" | "width">[];
  yAxis: AxisWords;
  window_s?: number;
  yRange?: [number, number];
  /** Smallest height of y that is shown, so that noise alone does not fill the plot. */
  leastHeight?: number;
  paused?: boolean;
  testId?: string;
}

const kNone: ReadonlySet<string> = new Set();
const kBuckets = 600;
const kPicture_ms = 15;

/** The last seconds of a stream. */
export function LivePlot(props: LivePlotProps) {
  const place = useRef<HTMLDivElement>(null);
  const newest = useRef(props);
  newest.current = props;
  const shape = props.series.map((one) => [one.label, one.colour, one.dashed].join()).join("|");
  useEffect(() => animate(place.current!, () => newest.current), [props.buffer, shape, axisWords(props.yAxis), dark.value]);
  return (
    <div class="plot" data-testid={props.testId}>
      {props.series.length > 1 && <Legend series={props.series} hidden={kNone} />}
      <div ref={place} class="plot-canvas" role="img" aria-label={`${props.label}: the last ${props.window_s ?? 10} seconds, live`} />
    </div>
  );
}

function animate(place: HTMLElement, props: () => LivePlotProps): () => void {
  const { buffer, series, yAxis } = props();
  const x = new Float64Array(2 * kBuckets);
  const ys = series.map(() => new Float64Array(2 * kBuckets));
  const size = () => ({ width: Math.max(120, place.clientWidth), height: Math.max(60, place.clientHeight) });
  const plot = new uPlot(
    {
      ...size(),
      padding: [8, 12, 0, 0],
      legend: { show: false },
      cursor: { show: false },
      scales: { x: { time: false, range: () => span(buffer, props()) }, y: { range: (_plot, low, high) => height(low, high, props()) } },
      axes: [axis({ label: "time", unit: "s" }, false, "x"), axis(yAxis, false, "y")],
      series: [{}, ...series.flatMap((one, index) => uSeries({ ...one, y: [] }, index))],
    },
    [[], ...series.map(() => [])] as unknown as uPlot.AlignedData,
    place,
  );
  let drawn = -1;
  const pace = new Pace(kPicture_ms);
  let frame = requestAnimationFrame(function draw(now_ms: number) {
    frame = requestAnimationFrame(draw);
    if (!pace.due(now_ms) || props().paused || buffer.version === drawn) return;
    pace.drew(now_ms);
    drawn = buffer.version;
    const count = buffer.recent(props().window_s ?? 10, x, ys);
    plot.setData([x.subarray(0, count), ...ys.map((y) => y.subarray(0, count))] as uPlot.AlignedData);
  });
  const observer = new ResizeObserver(() => plot.setSize(size()));
  observer.observe(place);
  return () => {
    cancelAnimationFrame(frame);
    observer.disconnect();
    plot.destroy();
  };
}

function span(buffer: LiveBuffer, { window_s = 10 }: LivePlotProps): [number, number] {
  const end_s = Math.max(buffer.newest_s, window_s);
  return [end_s - window_s, end_s];
}

function height(low: number | null, high: number | null, { yRange, leastHeight = 0 }: LivePlotProps): [number, number] {
  if (yRange) return yRange;
  if (low === null || high === null || !Number.isFinite(low + high)) return [0, leastHeight || 1];
  const middle = (low + high) / 2;
  const half = Math.max(0.55 * (high - low), leastHeight / 2, Math.abs(middle) * 1e-6 || 1e-9);
  return [middle - half, middle + half];
}
