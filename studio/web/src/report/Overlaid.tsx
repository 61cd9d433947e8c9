import { useMemo } from "preact/hooks";
import { profileX_mm, scaled } from "../measured/measured";
import { Plot } from "../plot/Plot";
import type { Series, SeriesColour } from "../plot/series";
import { Drawing } from "./Drawing";
import type { Result } from "./result";

const kColours: SeriesColour[] = [1, 2, 3, 4, 5, 6, 7, 8];
const kWay = { label: "Path length", unit: "mm" };
const kPlots = [
  { title: "Texture", array: "profile_texture_m", factor: 1e6, unit: "µm" },
  { title: "Height", array: "profile_height_m", factor: 1e6, unit: "µm" },
  { title: "Force", array: "profile_force_N", factor: 1, unit: "N" },
  { title: "Speed", array: "profile_speed_mps", factor: 1e3, unit: "mm/s" },
];

/** Several profiles over each other, each from where its path begins. */
export function Overlaid({ results }: { results: Result[] }) {
  const plots = useMemo(() => {
    const ways = results.map(({ measured }) => profileX_mm(measured));
    const series = (array: string, factor: number): Series[] =>
      results.map(({ name, measured }, index) => ({ label: name, x: ways[index]!, y: scaled(measured.array(array), factor), colour: kColours[index % kColours.length]! }));
    return kPlots.map((plot) => ({ ...plot, series: series(plot.array, plot.factor) }));
  }, [results]);
  return (
    <>
      {plots.map(({ title, unit, series }) => (
        <Drawing key={title} title={title} note={title === "Texture" ? "The height after the high-pass, each from the start of its path." : undefined}>
          <Plot label={`${title} of all results along the path`} series={series} xAxis={kWay} yAxis={{ label: title, unit }} syncKey="report" legend />
        </Drawing>
      ))}
    </>
  );
}
