import { number } from "../ui/format";
import { axisWords } from "./options";
import type { PlotProps } from "./props";

/** What a plot shows, in words: for each series its count and range. */
export function summary({ series, xAxis, yAxis }: Pick<PlotProps, "series" | "xAxis" | "yAxis">): string {
  const each = series.map((one) => {
    let low = Infinity;
    let high = -Infinity;
    for (let index = 0; index < one.y.length; ++index) {
      const value = one.y[index]!;
      if (value < low) low = value;
      if (value > high) high = value;
    }
    const unit = yAxis.unit ? ` ${yAxis.unit}` : "";
    return low <= high ? `${one.label}: ${one.y.length} points, ${number(low, 3)} to ${number(high, 3)}${unit}.` : `${one.label}: empty.`;
  });
  return `${axisWords(yAxis)} over ${axisWords(xAxis)}. ${each.join(" ")}`;
}
