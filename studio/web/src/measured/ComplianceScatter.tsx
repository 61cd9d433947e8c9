import { useMemo } from "preact/hooks";
import { Plot } from "../plot/Plot";
import type { Series } from "../plot/series";
import { number, withError } from "../ui/format";
import { sortedByX, type Measured } from "./measured";

/** The force-acceleration ratio of every window over its force, with the mean line (thesis Fig. 34): flat where it is stiff. */
export function ComplianceScatter({ measured }: { measured: Measured }) {
  const series = useMemo<Series[]>(() => {
    const points = sortedByX(measured.array("compliance_force_N"), measured.array("compliance_ratio"));
    if (points.x.length === 0) return [];
    const ends = Float64Array.of(points.x[0]!, points.x[points.x.length - 1]!);
    const { exponent } = measured.compliance;
    const out: Series[] = [
      { label: "Window", x: points.x, y: points.y, kind: "points", colour: 1, width: 5 },
      { label: "Mean", x: ends, y: Float64Array.of(1, 1), colour: "muted", dashed: true },
    ];
    if (exponent !== null) out.push({ label: "Power of the force", ...powerLine(points.x, points.y, exponent), colour: 2 });
    return out;
  }, [measured]);
  const { k_c, k_c_stderr, k_c_low, k_c_high, verdict, exponent, exponent_error } = measured.compliance;
  return (
    <div class="measured-column">
      <Plot
        label="Ratio of force to acceleration over the mean force, one point per window"
        series={series}
        xAxis={{ label: "Mean force", unit: "N" }}
        yAxis={{ label: "Ratio over its mean" }}
        empty="No window of the scan had enough speed and force. Vary the force from light to firm while you scan."
        testId="plot-compliance"
      />
      <p class="measured-note" data-testid="compliance-words">
        {k_c === null
          ? `Compliance coefficient ${verdict ?? "not determined: the force of a stroke must go from light to firm"}.`
          : `k_c = ${withError(k_c, k_c_stderr ?? null)}, 95 %: ${number(k_c_low ?? null, 3)} to ${number(k_c_high ?? null, 3)}, for forces of 0.5 to 1.5 N (1 stiff, towards 0 soft). Ratio ∝ force^${withError(exponent, exponent_error)} at 1 N.`}
      </p>
    </div>
  );
}

/** c·F^n through the middle of the points in logarithms, at twenty forces. */
export function powerLine(force: Float64Array, ratio: Float64Array, exponent: number): { x: Float64Array; y: Float64Array } {
  let sum = 0;
  for (let i = 0; i < force.length; ++i) sum += Math.log(ratio[i]!) - exponent * Math.log(force[i]!);
  const c = Math.exp(sum / force.length);
  const low = force[0]!;
  const high = force[force.length - 1]!;
  const x = Float64Array.from({ length: 20 }, (_, i) => low + ((high - low) * i) / 19);
  return { x, y: x.map((F) => c * F ** exponent) };
}
