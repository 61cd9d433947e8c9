// A plot as a picture of lines and letters, for papers: what is shown, at full sharpness.
import { axisWords, logWords, tickWords } from "./options";
import type { PlotProps } from "./props";
import { columnsBetween, type Column, type Series } from "./series";
import { decadeTicks, linearTicks } from "./ticks";
import type { Range } from "./zoom";

export interface SvgLook {
  width: number;
  height: number;
  background: string;
  text: string;
  grid: string;
  /** A colour for each series. */
  colours: readonly string[];
}

type Plotted = Pick<PlotProps, "label" | "series" | "x" | "xAxis" | "yAxis" | "logX" | "logY" | "yRange" | "marks">;

const kBuckets = 2000;
const kMargin = { left: 64, right: 16, top: 12, bottom: 44 };
const kLegendRow_px = 18;
const kFont_px = 12;
const kEdge = 0.06;

const escaped = (text: string): string => text.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]!);
const short = (value: number): string => String(Math.round(100 * value) / 100);

/** The part of the plot within `range` of x, without the series that are hidden. */
export function plotSvg(plot: Plotted, range: Range, look: SvgLook): string {
  const kept = plot.series.map((series, index) => ({ series, colour: look.colours[index]! })).filter(({ series }) => !series.hidden);
  const shown = kept.map(({ series }) => series);
  const { data, at } = columnsBetween(plot.x, shown, range.min, range.max, kBuckets);
  const [low, high] = plot.yRange ?? yRange(data.slice(1), plot.logY ?? false);
  const legend = shown.length > 1 ? shown.length * kLegendRow_px : 0;
  const box = { left: kMargin.left, top: kMargin.top + legend, width: look.width - kMargin.left - kMargin.right, height: look.height - kMargin.top - kMargin.bottom - legend };
  const toX = placed(range.min, range.max, box.left, box.left + box.width, plot.logX ?? false);
  const toY = placed(low, high, box.top + box.height, box.top, plot.logY ?? false);
  const parts = [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${look.width}" height="${look.height}" viewBox="0 0 ${look.width} ${look.height}" font-family="sans-serif" font-size="${kFont_px}">`,
    `<title>${escaped(plot.label)}</title>`,
    `<rect width="100%" height="100%" fill="${look.background}"/>`,
    `<clipPath id="box"><rect x="${short(box.left)}" y="${short(box.top)}" width="${short(box.width)}" height="${short(box.height)}"/></clipPath>`,
    ...xAxis(plot, range, toX, box, look),
    ...yAxis(plot, low, high, toY, box, look),
    `<g clip-path="url(#box)">`,
    ...kept.flatMap(({ series, colour }, index) => lines(series, colour, data, at[index]!, toX, toY)),
    ...(plot.marks ?? []).filter(({ x }) => x >= range.min && x <= range.max).map(({ x, label }) => mark(toX(x), label, box, look)),
    `</g>`,
    `<rect x="${short(box.left)}" y="${short(box.top)}" width="${short(box.width)}" height="${short(box.height)}" fill="none" stroke="${look.text}"/>`,
    ...(legend ? kept.map(({ series, colour }, index) => legendRow(series, colour, index, look)) : []),
    `</svg>`,
  ];
  return parts.join("\n") + "\n";
}

interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}
type Place = (value: number) => number;

function placed(low: number, high: number, from: number, to: number, logarithmic: boolean): Place {
  const scale = logarithmic ? Math.log10 : (value: number) => value;
  return (value) => from + ((scale(value) - scale(low)) / (scale(high) - scale(low))) * (to - from);
}

function yRange(columns: readonly Column[], logarithmic: boolean): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (const column of columns) {
    for (const value of column) {
      if (value == null || !Number.isFinite(value) || (logarithmic && value <= 0)) continue;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  if (low > high) return logarithmic ? [0.1, 1] : [0, 1];
  if (logarithmic) return [10 ** Math.floor(Math.log10(Math.max(low, high / 1e8))), 10 ** Math.ceil(Math.log10(high))];
  const gap = high > low ? kEdge * (high - low) : Math.abs(high) || 1;
  return [low - gap, high + gap];
}

function xAxis(plot: Plotted, range: Range, toX: Place, box: Box, look: SvgLook): string[] {
  const ticks = plot.logX ? decadeTicks(range.min, range.max, box.width / 80) : linearTicks(range.min, range.max, box.width / 80);
  const words = plot.logX ? ticks.map(logWords) : tickWords(ticks);
  const bottom = box.top + box.height;
  return [
    ...ticks.map((value, i) => {
      const x = short(toX(value));
      return `<path d="M${x} ${short(box.top)}V${short(bottom)}" stroke="${look.grid}"/><text x="${x}" y="${short(bottom + 16)}" text-anchor="middle" fill="${look.text}">${escaped(words[i]!)}</text>`;
    }),
    `<text x="${short(box.left + box.width / 2)}" y="${short(bottom + 36)}" text-anchor="middle" fill="${look.text}">${escaped(axisWords(plot.xAxis))}</text>`,
  ];
}

function yAxis(plot: Plotted, low: number, high: number, toY: Place, box: Box, look: SvgLook): string[] {
  const ticks = plot.logY ? decadeTicks(low, high, box.height / 40) : linearTicks(low, high, box.height / 40);
  const words = plot.logY ? ticks.map(logWords) : tickWords(ticks);
  const middle = box.top + box.height / 2;
  return [
    ...ticks.map((value, i) => {
      const y = toY(value);
      return `<path d="M${short(box.left)} ${short(y)}h${short(box.width)}" stroke="${look.grid}"/><text x="${short(box.left - 6)}" y="${short(y + 4)}" text-anchor="end" fill="${look.text}">${escaped(words[i]!)}</text>`;
    }),
    `<text transform="translate(14 ${short(middle)}) rotate(-90)" text-anchor="middle" fill="${look.text}">${escaped(axisWords(plot.yAxis))}</text>`,
  ];
}

/** Runs of numbers, with gaps between; undefined is another series' row. */
function runs(x: Column, y: Column, toX: Place, toY: Place): [number, number][][] {
  const out: [number, number][][] = [[]];
  for (let row = 0; row < x.length; ++row) {
    const value = y[row];
    if (value === undefined) continue;
    const px = toX(x[row]!);
    const py = value === null ? NaN : toY(value);
    if (Number.isFinite(px) && Number.isFinite(py)) out[out.length - 1]!.push([px, py]);
    else if (out[out.length - 1]!.length > 0) out.push([]);
  }
  return out.filter((run) => run.length > 0);
}

const points = (run: readonly [number, number][]): string => run.map(([x, y]) => `${short(x)},${short(y)}`).join(" ");

function lines(series: Series, colour: string, data: readonly Column[], at: number, toX: Place, toY: Place): string[] {
  const out: string[] = [];
  if (series.lo && series.hi) {
    const low = runs(data[0]!, data[at - 2]!, toX, toY);
    const high = runs(data[0]!, data[at - 1]!, toX, toY);
    low.forEach((run, i) => high[i] && out.push(`<polygon points="${points(run)} ${points([...high[i]!].reverse())}" fill="${colour}" fill-opacity="0.22"/>`));
  }
  const found = runs(data[0]!, data[at]!, toX, toY);
  if (series.kind === "points") {
    const radius = short((series.width ?? 4) / 2);
    return [...out, ...found.flat().map(([x, y]) => `<circle cx="${short(x)}" cy="${short(y)}" r="${radius}" fill="${colour}"/>`)];
  }
  const dash = series.dashed ? ' stroke-dasharray="5 4"' : "";
  for (const run of found) {
    const drawn = series.kind === "step" ? run.flatMap(([x, y], i): [number, number][] => (i === 0 ? [[x, y]] : [[x, run[i - 1]![1]], [x, y]])) : run;
    out.push(`<polyline points="${points(drawn)}" fill="none" stroke="${colour}" stroke-width="${series.width ?? 1.4}" stroke-linejoin="round"${dash}/>`);
  }
  return out;
}

function mark(x: number, label: string, box: Box, look: SvgLook): string {
  return `<path d="M${short(x)} ${short(box.top)}v${short(box.height)}" stroke="${look.text}" stroke-dasharray="4 3"/><text x="${short(x + 4)}" y="${short(box.top + 14)}" fill="${look.text}">${escaped(label)}</text>`;
}

function legendRow(series: Series, colour: string, index: number, look: SvgLook): string {
  const y = kMargin.top + index * kLegendRow_px + 6;
  const dash = series.dashed ? ' stroke-dasharray="5 4"' : "";
  const sign =
    series.kind === "points"
      ? `<circle cx="${kMargin.left + 12}" cy="${y}" r="3" fill="${colour}"/>`
      : `<path d="M${kMargin.left} ${y}h24" stroke="${colour}" stroke-width="2"${dash}/>`;
  return `${sign}<text x="${kMargin.left + 32}" y="${y + 4}" fill="${look.text}">${escaped(series.label)}</text>`;
}
