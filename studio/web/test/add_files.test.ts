import { describe, expect, it } from "vitest";
import { addedWords, holdsHeights, isTable } from "../src/add/adding";
import { chosenFiles } from "../src/add/dropped";
import { textureName } from "../src/add/SurfaceDialog";
import { columnsText, recordingName, withMeaning, type PlanMeaning } from "../src/add/importPlan";

const file = (path: string): File => ({ name: path.split("/").pop()!, webkitRelativePath: path.includes("/") ? path : "" }) as File;
const meant = (meaning: string, number: number, unit = "", negative = false): PlanMeaning => ({ meaning, number, unit, negative, why: "its name" });

describe("chosen files", () => {
  it("have their paths, in order, without hidden ones", () => {
    const { files, hidden } = chosenFiles(["scan/b.csv", "scan/.git/x", "scan/a.csv", "z.txt"].map(file));
    expect(files.map(({ path }) => path)).toEqual(["scan/a.csv", "scan/b.csv", "z.txt"]);
    expect(hidden).toBe(1);
  });

  it("are named when they are there, with the name that they got", () => {
    expect(addedWords([{ from: "scan", name: "scan_2" }], 1)).toBe("Added scan as scan_2. 1 hidden file was left out.");
    expect(addedWords(["a", "b", "c", "d"].map((name) => ({ from: name, name })), 0)).toBe("Added a, b, c and 1 more.");
  });

  it("are tables by their endings, but not a study's log", () => {
    expect(["a.CSV", "b.tsv", "c.txt", "d.study.csv", "e.obj"].map(isTable)).toEqual([true, true, true, false, false]);
  });
});

describe("files of heights", () => {
  it("are an instrument's, and tables that may be", () => {
    expect(["a.SDF", "b.x3p", "c.tif", "d.csv", "e.obj", "f.study.csv"].map(holdsHeights)).toEqual([true, true, true, true, false, false]);
  });

  it("give a texture their name", () => {
    expect(textureName("maps/part 3.sdf")).toBe("part 3.texture.json");
  });
});

describe("columns of an import", () => {
  const map = [meant("t", 1, "ms"), meant("px", 2, "mm"), meant("qw", 3, "1"), meant("ax", 5, "1/16384 g", true)];

  it("are stated as the command line takes them", () => {
    expect(columnsText(map)).toBe("t=#1[ms], px=#2[mm], qw=#3, ax=-#5[1/16384 g]");
  });

  it("change one by one: a meaning belongs to one column, another quantity asks for its own unit", () => {
    expect(columnsText(withMeaning(map, 4, { meaning: "px" }))).toBe("t=#1[ms], qw=#3, px=#4, ax=-#5[1/16384 g]");
    expect(columnsText(withMeaning(map, 2, { unit: "m" }))).toBe("t=#1[ms], px=#2[m], qw=#3, ax=-#5[1/16384 g]");
    expect(columnsText(withMeaning(map, 2, { meaning: "py" }))).toBe("t=#1[ms], py=#2[mm], qw=#3, ax=-#5[1/16384 g]");
    expect(columnsText(withMeaning(map, 2, { meaning: "ax" }))).toBe("t=#1[ms], ax=#2, qw=#3");
    expect(columnsText(withMeaning(map, 1, { meaning: "" }))).toBe("px=#2[mm], qw=#3, ax=-#5[1/16384 g]");
  });

  it("make a recording that is named after the file", () => {
    expect(recordingName("motion/Take 1 (2).csv")).toBe("Take_1_2");
    expect(recordingName("...")).toBe("recording");
  });
});
