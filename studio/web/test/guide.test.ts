import { expect, test } from "vitest";
import { stepOf } from "../src/pages/scan/guideSteps";

const open = (storing: boolean, segments: number) => ({ open: true, recorder: { storing, segments: Array(segments).fill({}) } });

test("the guide follows the scan: open, start, stop, wait, done", () => {
  expect(stepOf(null, undefined)).toBe(0);
  expect(stepOf({ open: false }, { recording: "scan" })).toBe(0);
  expect(stepOf(open(false, 0), undefined)).toBe(1);
  expect(stepOf(open(true, 1), undefined)).toBe(2);
  expect(stepOf(open(false, 1), undefined)).toBe(3);
  expect(stepOf(open(false, 1), { failure: "too short" })).toBe(3);
  expect(stepOf(open(false, 1), { recording: "scan", segment: "segment_1" })).toBe(4);
});
