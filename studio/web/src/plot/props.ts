import type { Cursors } from "./cursors";
import type { AxisWords } from "./options";
import type { Series } from "./series";

/** What a <Plot> is given. */
export interface PlotProps {
  /** What the plot shows; read out with a summary of the series. */
  label: string;
  series: readonly Series[];
  /** Common x of all series that have none of their own; rising. */
  x?: ArrayLike<number>;
  xAxis: AxisWords;
  yAxis: AxisWords;
  logX?: boolean;
  logY?: boolean;
  /** Plots with the same key share the cursor, the zoom and the measuring cursors. */
  syncKey?: string;
  /** Fixed range of y; without it what is shown fits. */
  yRange?: [number, number];
  /** Room for the y axis' numbers, so that plots above one another begin at the same position. */
  yAxisRoom_px?: number;
  /** Upright lines with words, at values of x. */
  marks?: readonly { x: number; label: string }[];
  /** Measuring cursors, drawn as marks; a <Plot> sets them itself. */
  cursors?: Cursors | null;
  /** x under the cursor, or null. */
  onCursor?(x: number | null): void;
  /** A click, at this x. */
  onPick?(x: number): void;
  /** The range of x that is shown, after each zoom. */
  onRange?(low: number, high: number): void;
  legend?: boolean;
  empty?: string;
  testId?: string;
}
