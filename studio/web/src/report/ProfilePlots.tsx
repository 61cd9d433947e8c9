import type { ComponentChildren } from "preact";
import { Plot } from "../plot/Plot";
import type { Series, SeriesColour } from "../plot/series";
import type { Result } from "./result";

const kColours: SeriesColour[] = [1, 2, 3, 4, 5, 6, 7, 8];
const s = { label: "along the path", unit: "mm" };

const scaled = (values: Float32Array, factor: number): Float64Array => Float64Array.from(values, (value) => value * factor);
const colourOf = (index: number): SeriesColour => kColours[index % kColours.length]!;

/** Height with its band of one standard deviation, the texture, force and speed; all over the same length. */
export function ProfilePlots({ results }: { results: Result[] }) {
  const several = results.length > 1;
  const x = (result: Result) => scaled(result.profile.s_m, 1e3);
  const lines = (name: "texture_m" | "force_N" | "speed_mps", factor: number): Series[] =>
    results.map((result, index) => ({ label: result.name, x: x(result), y: scaled(result.profile[name], factor), colour: colourOf(index) }));
  return (
    <>
      <Drawing title="Height" note={`Along the outward normal, only the base shape removed; the band is one standard deviation.${thinned(results)}`} tall>
        <Plot
          label="Height along the path"
          series={results.map((result, index) => heightSeries(result, x(result), colourOf(index)))}
          xAxis={s}
          yAxis={{ label: "height", unit: "µm" }}
          syncKey="report"
          legend={several}
        />
      </Drawing>
      <Drawing title="Texture" note={`The height after the high-pass${cutoff(results)}.`}>
        <Plot label="Texture along the path" series={lines("texture_m", 1e6)} xAxis={s} yAxis={{ label: "texture", unit: "µm" }} syncKey="report" legend={several} />
      </Drawing>
      <div class="report-pair">
        <Drawing title="Force">
          <Plot label="Force along the path" series={lines("force_N", 1)} xAxis={s} yAxis={{ label: "force", unit: "N" }} syncKey="report" legend={several} />
        </Drawing>
        <Drawing title="Speed">
          <Plot label="Speed along the path" series={lines("speed_mps", 1e3)} xAxis={s} yAxis={{ label: "speed", unit: "mm/s" }} syncKey="report" legend={several} />
        </Drawing>
      </div>
    </>
  );
}

function heightSeries(result: Result, x: Float64Array, colour: SeriesColour): Series {
  const { height_m, sigma_m } = result.profile;
  const series: Series = { label: result.name, x, y: scaled(height_m, 1e6), colour };
  if (!sigma_m.some(Number.isFinite)) return series;
  return { ...series, lo: height_m.map((height, index) => (height - sigma_m[index]!) * 1e6), hi: height_m.map((height, index) => (height + sigma_m[index]!) * 1e6) };
}

export function Drawing({ title, note, tall, children }: { title: string; note?: string; tall?: boolean; children: ComponentChildren }) {
  return (
    <section class="report-drawing" aria-label={title}>
      <h2>{title}</h2>
      {note && <p class="report-note">{note}</p>}
      <div class={tall ? "report-plot report-tall" : "report-plot"}>{children}</div>
    </section>
  );
}

function cutoff(results: Result[]): string {
  const all = new Set(results.map((result) => result.json.profile?.high_pass_cycles_per_mm));
  const [only] = all;
  return all.size === 1 && typeof only === "number" ? ` of ${only} cycles/mm` : "";
}

function thinned(results: Result[]): string {
  const most = Math.max(...results.map((result) => Math.round(result.profilePoints / Math.max(1, result.profile.s_m.length))));
  return most > 1 ? ` Every ${most}th height is drawn.` : "";
}
