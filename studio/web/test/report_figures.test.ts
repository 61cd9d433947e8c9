import { describe, expect, it } from "vitest";
import { figureWords, type MeasuredFigure } from "../src/measured/measured";
import { comparedRows } from "../src/report/compare";

const figure = (label: string, value: MeasuredFigure["value"], unit = "", more: Partial<MeasuredFigure> = {}): MeasuredFigure => ({ group: "Scan", key: "", label, value, unit, ...more });
const plain = (text: string) => text.replaceAll("\u202f", " ");

describe("figures as text", () => {
  it("have few digits and their unit", () => {
    expect(plain(figureWords(figure("Path length", 80.078, "mm")))).toBe("80.08 mm");
    expect(plain(figureWords(figure("Pitch", 2.5019, "mm", { error: 0.00114 })))).toBe("2.5019 ± 0.0011 mm");
    expect(figureWords(figure("Periodic", "yes"))).toBe("yes");
  });

  it("are whole where they count, and a dash where there is none", () => {
    expect(figureWords(figure("Gaps", 1, "", { count: true }))).toBe("1");
    expect(figureWords(figure("Gaps", null, "", { count: true }))).toBe("–");
    expect(figureWords(figure("RSm", null, "mm"))).toBe("–");
  });
});

describe("figures of several results", () => {
  it("stand side by side, and a missing one is a dash", () => {
    const rows = comparedRows([[figure("Path length", 10, "mm")], [figure("Path length", 20, "mm"), figure("Duration", 3, "s")]]);
    expect(rows.map((row) => [row.label, ...row.values.map(plain)])).toEqual([
      ["Path length", "10.00 mm", "20.00 mm"],
      ["Duration", "–", "3.000 s"],
    ]);
  });

  it("are left out where they are sentences or nobody has them", () => {
    expect(comparedRows([[figure("In words", "it is stiff, at least 3 N/mm"), figure("RSm", null, "mm")]])).toEqual([]);
  });

  it("of one name in two groups are two", () => {
    const rows = comparedRows([[figure("Length", 1, "mm"), { ...figure("Length", 2, "mm"), group: "Texture" }]]);
    expect(rows.map(({ group, values }) => [group, plain(values[0]!)])).toEqual([["Scan", "1.000 mm"], ["Texture", "2.000 mm"]]);
  });
});
