import { number } from "../ui/format";
import type { PlotProps } from "./Plot";
import { nearest, type Series } from "./series";

/** The values of the series at an x, in words. */
export function readout({ x: common, xAxis, yAxis }: Pick<PlotProps, "x" | "xAxis" | "yAxis">, series: readonly Series[], x: number): string {
  const values = series
    .filter((one) => !one.hidden)
    .map((one) => {
      const own = one.x ?? common ?? [];
      const value = number(one.y[nearest(own, x)], 4);
      return series.length > 1 ? `${one.label} ${value}` : value;
    });
  return `${number(x, 4)} ${xAxis.unit ?? ""}: ${values.join(", ")} ${yAxis.unit ?? ""}`.trim();
}
