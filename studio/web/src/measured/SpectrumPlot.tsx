import { useMemo } from "preact/hooks";
import { Plot } from "../plot/Plot";
import { scaled, spectrumPoints, type Measured } from "./measured";

const kSquareMicrometres = 1e12;

/** The texture's power over spatial frequency with its 95 % interval; the pattern's pitch is marked. */
export function SpectrumPlot({ measured }: { measured: Measured }) {
  const spectrum = useMemo(() => {
    const frequency = measured.array("spectrum_cycles_per_mm");
    const scaledArray = (name: string) => scaled(measured.array(name), kSquareMicrometres);
    return spectrumPoints(frequency, scaledArray("spectrum_density_m2_mm"), scaledArray("spectrum_low_m2_mm"), scaledArray("spectrum_high_m2_mm"));
  }, [measured]);
  const pitch_mm = measured.figures.find((figure) => figure.key === "periodicity.pitch_m")?.value;
  const periodic = measured.figures.some((figure) => figure.key === "periodicity.periodic" && figure.value === "yes");
  const marks = useMemo(
    () => (periodic && typeof pitch_mm === "number" ? [{ x: 1 / pitch_mm, label: `pitch ${pitch_mm.toFixed(2)}\u202fmm` }] : []),
    [pitch_mm, periodic],
  );
  return (
    <Plot
      label="Power spectral density of the texture over spatial frequency, both logarithmic"
      x={spectrum.x}
      series={useMemo(() => {
        const { y, lo, hi } = spectrum;
        return [{ label: lo ? "Density, 95\u202f% interval" : "Density", y, ...(lo && hi ? { lo, hi } : {}), colour: 1 as const }];
      }, [spectrum])}
      xAxis={{ label: "Spatial frequency", unit: "cycles/mm" }}
      yAxis={{ label: "Density", unit: "µm²·mm" }}
      logX
      logY
      marks={marks}
      empty="The profile is too short, or has too many gaps, for a spectrum."
      testId="plot-spectrum"
    />
  );
}
