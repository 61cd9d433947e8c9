import { describe, expect, it } from "vitest";
import { softened, VibrationReader } from "../src/pages/feel/vibrationReader";

const kIn_Hz = 1000;
const kOut_Hz = 48000;

/** Plays a wave that comes in pieces of `piece_s`; the output, and the reader. */
function play(wave: (t_s: number) => number, duration_s: number, inputRate_Hz = kIn_Hz, piece_s = 1 / 60) {
  const reader = new VibrationReader({ inputRate_Hz, outputRate_Hz: kOut_Hz, buffer_s: 0.04 });
  const out: number[] = [];
  const block = new Float32Array(128);
  let pushed = 0;
  for (let t_s = 0; t_s < duration_s; t_s = out.length / kOut_Hz) {
    const due = Math.floor(Math.floor(t_s / piece_s) * piece_s * inputRate_Hz);
    if (due > pushed) {
      reader.push(Float32Array.from({ length: due - pushed }, (_, index) => wave((pushed + index) / inputRate_Hz)));
      pushed = due;
    }
    reader.read(block);
    out.push(...block);
  }
  return { out, reader };
}

const rms = (values: number[]) => Math.sqrt(values.reduce((sum, value) => sum + value * value, 0) / values.length);

describe("the reader of vibrations", () => {
  it("keeps the level of what is within its band", () => {
    for (const f_Hz of [50, 120, 250]) {
      const { out } = play((t_s) => Math.sin(2 * Math.PI * f_Hz * t_s), 1);
      expect(rms(out.slice(kOut_Hz / 2))).toBeCloseTo(Math.SQRT1_2, 1);
    }
  });

  it("makes no tone beyond the input's band", () => {
    // 100 Hz at 1 kHz has its first image at 900 Hz.
    const { out } = play((t_s) => Math.sin(2 * Math.PI * 100 * t_s), 1);
    const steady = out.slice(kOut_Hz / 2);
    let imageSin = 0;
    let imageCos = 0;
    steady.forEach((value, index) => {
      const phase = (2 * Math.PI * 900 * index) / kOut_Hz;
      imageSin += value * Math.sin(phase);
      imageCos += value * Math.cos(phase);
    });
    expect((2 * Math.hypot(imageSin, imageCos)) / steady.length).toBeLessThan(0.01);
  });

  it("is silent before enough waits, and begins without a step", () => {
    const { out } = play(() => 1, 0.3);
    expect(out.slice(0, 0.03 * kOut_Hz).every((value) => value === 0)).toBe(true);
    const steps = out.slice(1).map((value, index) => Math.abs(value - out[index]!));
    expect(Math.max(...steps)).toBeLessThan(0.01);
    expect(out[out.length - 1]).toBeCloseTo(1, 2);
  });

  it("fades out when nothing comes any more, and goes on later", () => {
    const reader = new VibrationReader({ inputRate_Hz: kIn_Hz, outputRate_Hz: kOut_Hz, buffer_s: 0.04 });
    const out = new Float32Array(kOut_Hz / 2);
    reader.push(new Float32Array(100).fill(1));
    reader.read(out);
    const steps = Array.from(out.slice(1), (value, index) => Math.abs(value - out[index]!));
    expect(Math.max(...steps)).toBeLessThan(0.01);
    expect(out[out.length - 1]).toBe(0);
    reader.push(new Float32Array(200).fill(1));
    reader.read(out);
    expect(Math.max(...out)).toBeCloseTo(1, 2);
  });

  it("follows a clock that is half a percent off without running out", () => {
    for (const factor of [0.995, 1.005]) {
      const reader = new VibrationReader({ inputRate_Hz: kIn_Hz, outputRate_Hz: 8000, buffer_s: 0.04 });
      const block = new Float32Array(80);
      let due = 0;
      let zeros = 0;
      for (let k = 0; k < 3000; ++k) {
        due += 10 * factor;
        const count = Math.floor(due);
        due -= count;
        reader.push(new Float32Array(count).fill(1));
        reader.read(block);
        if (k > 20) zeros += block.filter((value) => value < 0.9).length;
      }
      expect(zeros).toBe(0);
      expect(reader.waiting).toBeLessThan(200);
    }
  });

  it("leaves the oldest out when far too much comes, and bears what is no number", () => {
    const reader = new VibrationReader({ inputRate_Hz: kIn_Hz, outputRate_Hz: kOut_Hz, buffer_s: 0.04 });
    const out = new Float32Array(4800);
    reader.push(new Float32Array(100).fill(0.5));
    reader.read(out);
    reader.push(new Float32Array(100000).fill(NaN));
    reader.push([Infinity, -Infinity]);
    reader.read(out);
    expect(reader.waiting).toBeLessThan(300);
    expect(out.every(Number.isFinite)).toBe(true);
  });

  it("plays a faster loop too", () => {
    const { out } = play((t_s) => Math.sin(2 * Math.PI * 300 * t_s), 1, 4000);
    expect(rms(out.slice(kOut_Hz / 2))).toBeCloseTo(Math.SQRT1_2, 1);
  });
});

it("softens levels below a ceiling", () => {
  expect(softened(0.01, 0.8)).toBeCloseTo(0.01, 4);
  expect(softened(50, 0.8)).toBeLessThanOrEqual(0.8);
  expect(softened(-50, 0.8)).toBeGreaterThanOrEqual(-0.8);
});
