// How a plot looks: uPlot's options in the colours of the theme.
import uPlot from "uplot";
import { fixed, number, superscript } from "../ui/format";
import { faded, seriesColour, themeColour } from "./colours";
import type { Series } from "./series";

const kTall_px = 260;

export interface AxisWords {
  label: string;
  unit?: string;
}

export const axisWords = ({ label, unit }: AxisWords): string => (unit ? `${label} / ${unit}` : label);

/** `room_px` is what the y axis takes at the left; as much as its numbers need without it. */
export function axis(words: AxisWords, logarithmic: boolean, side: "x" | "y", room_px?: number): uPlot.Axis {
  const line = themeColour("--line");
  const font = `11px ${themeColour("--font")}`;
  return {
    stroke: themeColour("--text-2"),
    font,
    labelFont: font,
    ...(words.label ? { label: axisWords(words) } : {}),
    labelSize: words.label ? 16 : 0,
    labelGap: 0,
    gap: 4,
    size: side === "x" ? 22 : (room_px ?? ((_plot, words) => 12 + 7.3 * Math.max(2, ...(words ?? []).map((word) => word?.length ?? 0)))),
    space: side === "x" ? 64 : (_plot, _axis, _low, _high, room) => (room > kTall_px ? 44 : 26),
    grid: { stroke: line, width: 1, ...(logarithmic ? { filter: onlyDecades } : {}) },
    ticks: { stroke: line, width: 1, size: 4 },
    border: { show: true, stroke: themeColour("--line-strong"), width: 1 },
    values: logarithmic ? (_plot, splits) => splits.map((value) => (isDecade(value) ? decadeWords(value) : "")) : (_plot, splits) => tickWords(splits),
  };
}

const isDecade = (value: number): boolean => Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-9;

const onlyDecades: uPlot.Axis.Filter = (_plot, splits) => splits.map((value) => (isDecade(value) ? value : null));

/** A power of ten, short. */
function decadeWords(value: number): string {
  const exponent = Math.round(Math.log10(value));
  return Math.abs(exponent) <= 2 ? String(Number(value.toPrecision(1))) : `10${superscript(exponent)}`;
}

/** A value on a logarithmic axis: a power of ten, or as many digits as it has. */
export const logWords = (value: number): string => (isDecade(value) ? decadeWords(value) : number(value, 2));

/** All with the decimals that the step between them needs. */
export function tickWords(splits: (number | null)[]): string[] {
  const values = splits.filter((value): value is number => value !== null);
  const step = values.length > 1 ? Math.abs(values[1]! - values[0]!) : 1;
  const largest = Math.max(...values.map(Math.abs), 0);
  if (largest >= 1e6 || (step > 0 && step < 1e-5)) return splits.map((value) => (value === null ? "" : number(value, 3)));
  let decimals = 0;
  while (decimals < 6 && Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) > 1e-6) ++decimals;
  return splits.map((value) => (value === null ? "" : fixed(value, decimals)));
}

/** uPlot's series of one of ours: y, or lo, hi and y. */
export function uSeries(series: Series, index: number): uPlot.Series[] {
  const colour = seriesColour(series.colour, index);
  const points = series.kind === "points";
  const edge: uPlot.Series = { label: `${series.label}, band`, width: 0, stroke: "transparent", points: { show: false }, spanGaps: false };
  const y: uPlot.Series = {
    label: series.label,
    show: !series.hidden,
    stroke: colour,
    width: series.width ?? 1.4,
    spanGaps: false,
    ...(series.dashed ? { dash: [5, 4] } : {}),
    ...(points ? { paths: () => null, points: { show: true, size: series.width ?? 4, fill: colour, stroke: colour } } : { points: { show: false } }),
    ...(series.kind === "step" ? { paths: uPlot.paths.stepped!({ align: 1 }) } : {}),
  };
  return series.lo && series.hi ? [{ ...edge, show: !series.hidden }, { ...edge, show: !series.hidden }, y] : [y];
}

/** Filled bands between lo and hi. `at` is the column of each series' y. */
export function uBands(series: readonly Series[], at: readonly number[]): uPlot.Band[] {
  return series.flatMap((one, index) =>
    one.lo && one.hi ? [{ series: [at[index]! - 1, at[index]! - 2] as [number, number], fill: faded(seriesColour(one.colour, index), 0.22) }] : [],
  );
}
