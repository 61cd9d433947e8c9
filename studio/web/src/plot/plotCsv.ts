// All values of a plot as a table.
import { csvLine } from "../save/files";
import { axisWords } from "./options";
import type { PlotProps } from "./props";
import type { Series } from "./series";

type Plotted = Pick<PlotProps, "series" | "x" | "xAxis" | "yAxis">;

const cell = (value: number | undefined): string => (value !== undefined && Number.isFinite(value) ? String(value) : "");

/**
 * A column of x and one for each series, with lower and upper edge where it has a band. Series with an x of their own:
 * a row a point, with the series' name. What is not a number is blank.
 */
export function plotCsv({ series, x, xAxis, yAxis }: Plotted): string {
  const shared = series.every((one) => one.x === undefined || one.x === x);
  return shared ? wide(series, x ?? [], axisWords(xAxis), yAxis.unit ?? "") : long(series, x ?? [], axisWords(xAxis), axisWords(yAxis));
}

function wide(series: readonly Series[], x: ArrayLike<number>, xName: string, unit: string): string {
  const named = (words: string) => (unit ? `${words} / ${unit}` : words);
  const columns: [string, ArrayLike<number>][] = [[xName, x]];
  for (const one of series) {
    columns.push([named(one.label), one.y]);
    if (one.lo && one.hi) columns.push([named(`${one.label}, lower`), one.lo], [named(`${one.label}, upper`), one.hi]);
  }
  let out = csvLine(columns.map(([name]) => name));
  for (let row = 0; row < x.length; ++row) out += columns.map(([, values]) => cell(values[row])).join(",") + "\r\n";
  return out;
}

function long(series: readonly Series[], x: ArrayLike<number>, xName: string, yName: string): string {
  const banded = series.some((one) => one.lo && one.hi);
  let out = csvLine(["Series", xName, yName, ...(banded ? ["lower", "upper"] : [])]);
  for (const one of series) {
    const own = one.x ?? x;
    for (let row = 0; row < own.length; ++row) {
      out += csvLine([one.label, cell(own[row]), cell(one.y[row]), ...(banded ? [cell(one.lo?.[row]), cell(one.hi?.[row])] : [])]);
    }
  }
  return out;
}
