import { expect, test } from "vitest";
import { delay, degrees, fixed, length, micrometres, millimetresPerSecond, newtons, number, quantity, withError } from "../src/ui/format";
import { parseNumber, shownNumber } from "../src/ui/numbers";

const T = "\u202f";

test.each([
  [0, "0"],
  [1.23456, "1.235"],
  [-12.3456, "−12.35"],
  [9.9996, "10.00"],
  [12345, "12345"],
  [0.000123456, "0.0001235"],
  [1.5e-7, `1.500${T}×${T}10⁻⁷`],
  [-2.5e8, `−2.500${T}×${T}10⁸`],
  [NaN, "–"],
  [null, "–"],
  [Infinity, "–"],
])("number(%s) is %s", (value, words) => expect(number(value)).toBe(words));

test("a fixed count of decimals has no negative zero", () => {
  expect(fixed(-0.001, 2)).toBe("0.00");
  expect(fixed(-1.5, 1)).toBe("−1.5");
});

test("units stand after a thin space, a degree sign without", () => {
  expect(quantity(3, "N", 2)).toBe(`3.0${T}N`);
  expect(degrees(Math.PI / 2)).toBe("90.0°");
  expect(micrometres(1.234e-5)).toBe(`12.34${T}µm`);
  expect(newtons(0.5)).toBe(`0.500${T}N`);
  expect(millimetresPerSecond(0.05)).toBe(`50.0${T}mm/s`);
  expect(micrometres(null)).toBe("–");
});

test("what is too little to mean anything is nothing", () => {
  expect(millimetresPerSecond(1e-12)).toBe(`0${T}mm/s`);
  expect(quantity(-5.6e-17, "mm")).toBe(`0${T}mm`);
  expect(quantity(2e-5, "mm")).toBe(`2.000${T}×${T}10⁻⁵${T}mm`);
  expect(length(1e-13)).toBe(`0${T}mm`);
  expect(length(2e-9)).toBe(`0.002000${T}µm`);
  expect(withError(1.5, 1e-16, "mm")).toBe(`1.500${T}mm`);
  expect(quantity(5.6e-17, "m/N")).toBe(`5.600${T}×${T}10⁻¹⁷${T}m/N`);
});

test("a delay is told in ms or s", () => {
  expect([delay(12.4), delay(12244), delay(NaN), delay(null)]).toEqual([`12${T}ms`, `12.2${T}s`, "–", "–"]);
});

test("a length is told in the unit that suits it", () => {
  expect(length(2e-6)).toBe(`2.000${T}µm`);
  expect(length(0.0123)).toBe(`12.30${T}mm`);
  expect(length(1.5)).toBe(`1.500${T}m`);
  expect(length(0)).toBe(`0${T}mm`);
});

test.each([
  [12.3456, 0.0512, "mm", `12.346${T}±${T}0.051${T}mm`],
  [-3.2, 1.7, "µm", `−3.2${T}±${T}1.7${T}µm`],
  [1234, 56, "", `1234${T}±${T}56`],
  [1234, 560, "", `1234${T}±${T}560`],
  [1.5, 0.0999, "", `1.50${T}±${T}0.10`],
  [1.5, null, "N", `1.500${T}N`],
  [NaN, 1, "N", "–"],
])("withError(%s, %s) is %s %s", (value, error, unit, words) => expect(withError(value, error, unit)).toBe(words));

test("numbers are read as people type them", () => {
  expect(parseNumber(" 1,5 ")).toBe(1.5);
  expect(parseNumber("−2e-3")).toBe(-0.002);
  expect(parseNumber(".5")).toBe(0.5);
  for (const none of ["", "1.2.3", "12 mm", "0x10", "1e999", "Infinity"]) expect(parseNumber(none)).toBeNull();
  expect(shownNumber(0.1 + 0.2)).toBe("0.3");
});
