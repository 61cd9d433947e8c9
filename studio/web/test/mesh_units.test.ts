import { describe, expect, it } from "vitest";
import { isSameUnit, meshUnits, takesProjectUnit, textOfLength, unitInForce, unitOfLength, unitOfText } from "../src/ui/meshUnits";

describe("the unit of a mesh", () => {
  it.each([["mm", 1e-3], ["cm", 1e-2], ["m", 1], ["", 1], ["0.06m", 0.06], ["25.4 mm", 0.0254], ["120nm", 1.2e-7], [".5um", 5e-7]])("%s is %d m", (text, unit_m) => {
    expect(unitOfText(text)).toBeCloseTo(unit_m, 15);
  });

  it.each(["-1mm", "0mm", "mm2", "1e999m0", "inch"])("%s is none", (text) => expect(unitOfText(text)).toBeNull());

  it("has a text that reads back", () => {
    for (const unit_m of [...meshUnits.map((one) => one.unit_m), 0.06, 3.3e-5]) expect(unitOfText(textOfLength(unit_m))).toBeCloseTo(unit_m, 15);
    for (const { text, unit_m } of meshUnits) expect(unitOfText(text)).toBe(unit_m);
  });

  it("is the page's, else the file's, else the project's", () => {
    expect(unitInForce("a.obj", "", "mm")).toBe("mm");
    expect(unitInForce("a.obj", "cm", "mm")).toBe("cm");
    expect(unitInForce("a.GLB", "", "mm")).toBe("m");
    expect(unitInForce("a.glb", "mm", "mm")).toBe("mm");
    expect(["a.obj", "a.STL", "a.gltf", "b/scene.json", ""].map((file) => takesProjectUnit(file, ""))).toEqual([true, true, false, false, false]);
    expect(takesProjectUnit("a.obj", "mm")).toBe(false);
    expect([isSameUnit("1000mm", "m"), isSameUnit("mm", "cm")]).toEqual([true, false]);
  });

  it("is known by its length, however that was worked out", () => {
    expect(unitOfLength(25.4 * 0.001)?.label).toBe("Inch");
    expect(unitOfLength(0.06)).toBeNull();
  });
});
