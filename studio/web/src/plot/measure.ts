// Two cursors of a plot, and what is between them.
import { floored, number, quantity, withUnit } from "../ui/format";
import type { CursorName, Cursors } from "./cursors";
import type { PlotProps } from "./props";
import { nearest, type Series } from "./series";
import type { Range } from "./zoom";

const kStep = 1 / 200;

/** Where the cursors begin: at a third and at two thirds of the shown range. */
export function firstCursors({ min, max }: Range, logarithmic: boolean): Cursors {
  const at = (share: number) => (logarithmic ? min * (max / min) ** share : min + share * (max - min));
  return { a: at(1 / 3), b: at(2 / 3) };
}

/** The cursor that is nearer to x moves there. */
export function placed(cursors: Cursors, x: number): Cursors {
  return Math.abs(cursors.a - x) <= Math.abs(cursors.b - x) ? { ...cursors, a: x } : { ...cursors, b: x };
}

/** One cursor a step of the shown range to the left (-1) or right (1), within that range. */
export function stepped(cursors: Cursors, which: CursorName, direction: number, shown: Range): Cursors {
  const x = cursors[which] + direction * kStep * (shown.max - shown.min);
  return { ...cursors, [which]: Math.min(Math.max(x, shown.min), shown.max) };
}

type Plotted = Pick<PlotProps, "x" | "xAxis" | "yAxis">;

const valueAt = (series: Series, x: number, common?: ArrayLike<number>): number => series.y[nearest(series.x ?? common ?? [], x)] ?? NaN;

/** "A 1.2 mm, B 3.4 mm: Δx 2.2 mm, Δz 12 µm": z for heights, y for all else. */
export function measured({ x: common, xAxis, yAxis }: Plotted, series: readonly Series[], { a, b }: Cursors): string {
  const unit = yAxis.unit ?? "";
  const name = unit.endsWith("m") ? "Δz" : "Δy";
  const shown = series.filter((one) => !one.hidden && one.y.length > 0);
  const differences = shown.map((one) => {
    const words = number(floored(valueAt(one, b, common) - valueAt(one, a, common), unit), 4);
    return shown.length > 1 ? `${one.label} ${words}` : words;
  });
  const along = (x: number) => quantity(x, xAxis.unit ?? "");
  return `A ${along(a)}, B ${along(b)}: Δx ${along(b - a)}, ${name} ${withUnit(differences.join(", "), unit)}`;
}
