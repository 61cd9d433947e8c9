// Reads a stream of samples at one rate at another: a ring, band-limited interpolation, and a clock that follows how
// full the ring is, since the servo's and the sound card's differ. No allocation after it was made.

const kTaps = 16;
const kPhases = 256;
const kMostCorrection = 0.02;
const kCorrection_s = 0.5;
const kFade_s = 0.005;

export interface VibrationReaderConfig {
  inputRate_Hz: number;
  outputRate_Hz: number;
  /** Kept waiting, so that what comes in pieces does not run out. */
  buffer_s: number;
}

export class VibrationReader {
  private readonly ring: Float32Array;
  private readonly mask: number;
  private readonly table: Float32Array;
  private readonly step: number;
  private readonly wanted: number;
  private readonly gainStep: number;
  private readonly smoothing: number;
  private written = 0;
  private at = 0; // of the interpolation's middle, in samples since the beginning
  private playing = false;
  private gain = 0;
  private excess = 0;

  constructor(private readonly config: VibrationReaderConfig) {
    const { inputRate_Hz, outputRate_Hz, buffer_s } = config;
    this.step = inputRate_Hz / outputRate_Hz;
    this.wanted = buffer_s * inputRate_Hz + kTaps;
    this.gainStep = 1 / (kFade_s * outputRate_Hz);
    this.smoothing = 1 / (0.2 * outputRate_Hz);
    const size = 2 ** Math.ceil(Math.log2(8 * this.wanted + 64));
    this.ring = new Float32Array(size);
    this.mask = size - 1;
    this.table = sincTable(Math.min(1, outputRate_Hz / inputRate_Hz));
  }

  /** Samples that wait. */
  get waiting(): number {
    return this.written - this.at;
  }

  /** The newest samples. What is not a number is silence. Too many: the oldest are left out. */
  push(samples: ArrayLike<number>): void {
    for (let index = 0; index < samples.length; ++index) {
      const value = samples[index]!;
      this.ring[this.written++ & this.mask] = Number.isFinite(value) ? value : 0;
    }
    if (this.playing && this.waiting > 4 * this.wanted) this.at = this.written - this.wanted;
  }

  /** Fills `out`; silent until enough waits, and faded where it runs out. */
  read(out: Float32Array): void {
    if (!this.playing && this.waiting >= this.wanted) {
      this.at = Math.max(kTaps, this.written - this.wanted);
      this.playing = true;
      this.excess = 0;
    }
    const corrected = this.excess / (this.config.inputRate_Hz * kCorrection_s);
    const step = this.step * (1 + Math.min(kMostCorrection, Math.max(-kMostCorrection, corrected)));
    for (let index = 0; index < out.length; ++index) {
      if (!this.playing) {
        out[index] = 0;
        continue;
      }
      const endsIn = (this.waiting - kTaps / 2 - 1) / this.step;
      const aim = endsIn * this.gainStep < 1 ? 0 : 1;
      this.gain += Math.min(this.gainStep, Math.max(-this.gainStep, aim - this.gain));
      out[index] = endsIn > 0 ? this.gain * this.interpolated() : 0;
      if (endsIn > 0) this.at += step;
      else {
        this.playing = false;
        this.gain = 0;
      }
    }
    this.excess += Math.min(1, this.smoothing * out.length) * (this.waiting - this.wanted - this.excess);
  }

  private interpolated(): number {
    const whole = Math.floor(this.at);
    const row = Math.min(kPhases - 1, Math.floor((this.at - whole) * kPhases)) * kTaps;
    let sum = 0;
    for (let tap = 0; tap < kTaps; ++tap) {
      sum += this.table[row + tap]! * this.ring[(whole + tap - kTaps / 2 + 1) & this.mask]!;
    }
    return sum;
  }
}

/** Windowed sines over x for each phase, their sums 1. `cutoff` is of the input's own highest frequency. */
function sincTable(cutoff: number): Float32Array {
  const table = new Float32Array(kPhases * kTaps);
  for (let phase = 0; phase < kPhases; ++phase) {
    let sum = 0;
    for (let tap = 0; tap < kTaps; ++tap) {
      const x = tap - kTaps / 2 + 1 - (phase + 0.5) / kPhases;
      const sinc = x === 0 ? 1 : Math.sin(Math.PI * cutoff * x) / (Math.PI * cutoff * x);
      const window = 0.5 + 0.5 * Math.cos((Math.PI * x) / (kTaps / 2 + 0.5));
      table[phase * kTaps + tap] = sinc * window;
      sum += sinc * window;
    }
    for (let tap = 0; tap < kTaps; ++tap) table[phase * kTaps + tap]! /= sum;
  }
  return table;
}

/** Bends levels softly below `ceiling`, which none exceeds. */
export const softened = (level: number, ceiling: number): number => ceiling * Math.tanh(level / ceiling);
