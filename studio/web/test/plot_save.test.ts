import { describe, expect, it } from "vitest";
import { plotCsv } from "../src/plot/plotCsv";
import { plotSvg } from "../src/plot/plotSvg";
import { decadeTicks, linearTicks } from "../src/plot/ticks";
import { csvLine, fileName } from "../src/save/files";
import { figureRows } from "../src/measured/measured";

const kLook = { width: 400, height: 300, background: "#fff", text: "#000", grid: "#ccc", colours: ["#123456", "#abcdef"] };
const axes = { xAxis: { label: "Way", unit: "mm" }, yAxis: { label: "Height", unit: "µm" } };

describe("a plot's values", () => {
  it("are columns where all series share x, with their bands, all digits and blanks for what is no number", () => {
    const csv = plotCsv({ ...axes, x: [0, 0.1], series: [{ label: "Height", y: [1 / 3, NaN], lo: [0, 1], hi: [2, 3] }] });
    expect(csv).toBe("Way / mm,Height / µm,\"Height, lower / µm\",\"Height, upper / µm\"\r\n0,0.3333333333333333,0,2\r\n0.1,,1,3\r\n");
  });

  it("are a row a point where series have an x of their own", () => {
    const csv = plotCsv({ ...axes, x: [0], series: [{ label: "a", y: [1] }, { label: "b,c", x: [5, 6], y: [2, 3] }] });
    expect(csv.split("\r\n")).toEqual(["Series,Way / mm,Height / µm", "a,0,1", '"b,c",5,2', '"b,c",6,3', ""]);
  });
});

describe("a plot's picture", () => {
  const plot = { label: "a <b> & c", ...axes, x: [0, 1, 2, 3], series: [{ label: "one", y: [0, 10, NaN, 5] }] };

  it("has each stretch of numbers as one line at its place, and nothing in gaps", () => {
    const svg = plotSvg({ ...plot, yRange: [0, 10] }, { min: 0, max: 3 }, kLook);
    // The box is 64 … 384 wide and 12 … 256 high (y downwards).
    expect([...svg.matchAll(/<polyline points="([^"]+)"/g)].map(([, points]) => points)).toEqual(["64,256 170.67,12", "384,134"]);
    expect(svg).toContain("<title>a &lt;b&gt; &amp; c</title>");
    expect(svg).toContain("Way / mm");
  });

  it("leaves hidden series out, and its legend names those that are shown", () => {
    const series = [{ label: "one", y: [0, 1, 2, 3] }, { label: "two", y: [3, 2, 1, 0], hidden: true }, { label: "three", y: [1, 1, 1, 1] }];
    const svg = plotSvg({ ...plot, series }, { min: 0, max: 3 }, { ...kLook, colours: ["#1", "#2", "#3"] });
    expect(svg).toContain('stroke="#1"');
    expect(svg).not.toContain('stroke="#2"');
    expect(svg).toContain(">three</text>");
    expect(svg).not.toContain(">two</text>");
  });

  it("places values of logarithmic axes by their logarithm", () => {
    const svg = plotSvg({ ...plot, x: [1, 10, 100], series: [{ label: "one", y: [1, 10, 100] }], logX: true, logY: true }, { min: 1, max: 100 }, kLook);
    expect(svg).toContain('points="64,256 224,134 384,12"');
  });

  it("holds a dash of a million samples in a picture of some thousand", () => {
    const y = Float64Array.from({ length: 1_000_000 }, (_, i) => Math.sin(i));
    const svg = plotSvg({ ...plot, x: Float64Array.from(y, (_, i) => i), series: [{ label: "one", y }] }, { min: 0, max: 999_999 }, kLook);
    expect(svg.length).toBeLessThan(200_000);
  });
});

describe("ticks", () => {
  it("are round and within the range", () => {
    expect(linearTicks(0.03, 1.02, 5)).toEqual([0.2, 0.4, 0.6000000000000001, 0.8, 1]);
    expect(linearTicks(-1, 1, 4)).toEqual([-1, -0.5, 0, 0.5, 1]);
    expect(decadeTicks(0.02, 300, 10)).toEqual([0.1, 1, 10, 100]);
    expect(decadeTicks(2, 7, 4).every((value) => value >= 2 && value <= 7)).toBe(true);
  });
});

describe("files", () => {
  it("have names of letters, digits and dashes", () => {
    expect(fileName("Height over the base shape, along the path")).toBe("height-over-the-base-shape-along-the-path");
    expect(fileName("../../x")).toBe("x");
    expect(fileName("?")).toBe("asperity");
  });

  it("quote what a comma, a quote or a new line would break", () => {
    expect(csvLine(["a", "b,c", 'd"e', "f\ng"])).toBe('a,"b,c","d""e","f\ng"\r\n');
  });

  it("have a figure's value with all its digits", () => {
    expect(figureRows([{ group: "Roughness", label: "Rq", key: "roughness.Rq_m", value: 1.23456789, error: null, unit: "µm" }])[1]).toEqual(["Roughness", "Rq", "roughness.Rq_m", "1.23456789", "", "µm"]);
  });
});
