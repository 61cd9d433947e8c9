import { describe, expect, it } from "vitest";
import { figureGroups, namedFigure, shownFigure } from "../src/report/figures";
import { comparedRows } from "../src/report/compare";

const shown = (json: Record<string, any>, title: string, label: string) => {
  const row = figureGroups(json).find((group) => group.title === title)?.rows.find((one) => one.label === label);
  return row && shownFigure(row).replaceAll("\u202f", " ");
};

describe("figures", () => {
  it("have the unit that suits them", () => {
    const json = { length_m: 0.080078, roughness: { Rq_m: 0.00049236 }, periodicity: { periodic: true, pitch_m: 0.0025019, pitch_stderr_m: 1.14e-6 } };
    expect(shown(json, "The scan", "Length of the path")).toBe("80.08 mm");
    expect(shown(json, "The surface", "Rq")).toBe("492.4 µm");
    expect(shown(json, "The surface", "Pitch")).toBe("2.5019 ± 0.0011 mm");
  });

  it("are left out where the data did not allow them", () => {
    const json = { roughness: null, periodicity: { periodic: false, pitch_m: null }, stiffness: { measured: false, stiffness_N_per_mm: null, lower_bound_N_per_mm: 1.1 } };
    expect(shown(json, "The surface", "Ra")).toBeUndefined();
    expect(shown(json, "The surface", "Periodic")).toBe("no");
    expect(shown(json, "The surface", "Pitch")).toBeUndefined();
    expect(shown(json, "The contact", "Stiffness, at least")).toBe("1.100 N/mm");
    expect(figureGroups(json).some((group) => group.title === "Against the truth")).toBe(false);
  });

  it("of the trajectory take their unit from their name", () => {
    expect(namedFigure("latency_s", 0.0117)).toMatchObject({ label: "Latency", unit: "ms", factor: 1e3 });
    expect(namedFigure("probe_rate_Hz", 4000)).toMatchObject({ label: "Probe rate", unit: "Hz" });
    expect(namedFigure("accel_noise_mps2", 0.02)).toMatchObject({ label: "Accel noise", unit: "m/s²" });
    expect(namedFigure("latency_prior_sigmas", 0.4)).toMatchObject({ label: "Latency prior sigmas", unit: "" });
  });

  it("of several results stand side by side, and a missing one is a dash", () => {
    const rows = comparedRows([{ length_m: 0.01 }, { length_m: 0.02, duration_s: 3 }]);
    expect(rows.map((row) => [row.label, ...row.values.map((value) => value.replaceAll("\u202f", " "))])).toEqual([
      ["Length of the path", "10.00 mm", "20.00 mm"],
      ["Duration", "–", "3.000 s"],
    ]);
  });
});
