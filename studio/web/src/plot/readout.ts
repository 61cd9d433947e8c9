import { floored, number, quantity, withUnit } from "../ui/format";
import type { PlotProps } from "./props";
import { nearest, type Series } from "./series";

/** The values of the series at an x, in words. */
export function readout({ x: common, xAxis, yAxis }: Pick<PlotProps, "x" | "xAxis" | "yAxis">, series: readonly Series[], x: number): string {
  const values = series
    .filter((one) => !one.hidden)
    .map((one) => {
      const own = one.x ?? common ?? [];
      const value = number(floored(one.y[nearest(own, x)] ?? NaN, yAxis.unit ?? ""), 4);
      return series.length > 1 ? `${one.label} ${value}` : value;
    });
  return withUnit(`${quantity(x, xAxis.unit ?? "")}: ${values.join(", ")}`, yAxis.unit ?? "");
}
