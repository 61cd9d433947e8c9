// The table of scans that were repeated: one row a scan, and the mean of all with its standard deviation.
import { fixed, floored, number, withError } from "../ui/format";
import type { MeasuredFigure } from "./measured";

export interface RepeatedScan {
  name: string;
  correlation: number | null;
  rms_um: number | null;
  shift_m: number;
  pitch_m: number | null;
  depth_m: number | null;
}

export interface RepeatedRow {
  name: string;
  correlation: string;
  rms_um: string;
  shift_mm: string;
  pitch_mm: string;
  depth_um: string;
}

export function repeatedRows(scans: readonly RepeatedScan[], figures: readonly MeasuredFigure[]): RepeatedRow[] {
  const rows = scans.map((scan, index) => ({
    name: scan.name,
    correlation: index === 0 ? "–" : fixed(scan.correlation, 4),
    rms_um: index === 0 ? "–" : number(scan.rms_um, 3),
    shift_mm: index === 0 ? "–" : number(floored(1e3 * scan.shift_m, "mm"), 3),
    pitch_mm: number(scan.pitch_m && 1e3 * scan.pitch_m),
    depth_um: number(scan.depth_m && 1e6 * scan.depth_m),
  }));
  const mean = (key: string) => {
    const found = figures.find((one) => one.key === key);
    return found && typeof found.value === "number" ? withError(found.value, found.error) : "–";
  };
  return [...rows, { name: "Mean ± sd", correlation: mean("correlation"), rms_um: "–", shift_mm: "–", pitch_mm: mean("pitch_m"), depth_um: mean("depth_m") }];
}
