// Distances of the path to the mesh: their colours and their histogram.

export interface Residuals {
  distance_m: Float32Array;
  mean_m: number;
  rms_m: number;
  most_m: number;
  /** Standard deviation of each distance, as its scan states it; NaN where it states none. */
  sigma_m: Float32Array;
  /** Of each point: 1 another scan passes there, 2 it is on a texture of the scene, 3 both. */
  overlap: Uint8Array;
  /** Of the distances over their σ; null: no σ is stated. */
  rms_sigma: number | null;
  median_sigma_m: number | null;
  /** How near scans are that overlap. */
  overlap_m: number;
}

/** Dark blue to yellow, as bright as large, distinguished by the colour-blind (after cividis). */
const RAMP: readonly (readonly [number, number, number])[] = [
  [0.0, 0.135, 0.305],
  [0.19, 0.255, 0.42],
  [0.38, 0.38, 0.44],
  [0.55, 0.52, 0.46],
  [0.73, 0.66, 0.41],
  [0.91, 0.82, 0.3],
  [1.0, 0.92, 0.28],
];

/** The colour for a part from 0 to 1, each of three from 0 to 1 as a screen shows it. */
export function rampColour(part: number): [number, number, number] {
  const at = Math.max(0, Math.min(1, Number.isFinite(part) ? part : 1)) * (RAMP.length - 1);
  const low = Math.min(RAMP.length - 2, Math.floor(at));
  const [a, b] = [RAMP[low]!, RAMP[low + 1]!];
  return [0, 1, 2].map((k) => a[k]! + (at - low) * (b[k]! - a[k]!)) as [number, number, number];
}

/** What is not known: neither near nor far. */
const UNKNOWN: readonly [number, number, number] = [0.75, 0.3, 0.6];

/** Colours of distances up to `limit`, in the linear light that three.js needs; NaN has a colour outside of the ramp. */
export function residualColours(distance: ArrayLike<number>, limit: number): Float32Array {
  const out = new Float32Array(3 * distance.length);
  for (let index = 0; index < distance.length; ++index) {
    const size = Math.abs(distance[index]!);
    const colour = Number.isNaN(size) ? UNKNOWN : rampColour(size / limit);
    for (let k = 0; k < 3; ++k) out[3 * index + k] = linear(colour[k]!);
  }
  return out;
}

const linear = (s: number): number => (s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4);

/** The ramp as CSS colour stops, for the legend. */
export const rampStops = (): string =>
  RAMP.map((_, index) => {
    const [r, g, b] = rampColour(index / (RAMP.length - 1)).map((part) => Math.round(255 * part));
    return `rgb(${r} ${g} ${b})`;
  }).join(", ");

/** A round limit for the colours: where 95 % of the distances lie below, at least 10 µm. */
export const colourLimit_m = (distance_m: ArrayLike<number>): number => roundLimit(distance_m, 1e-5);

/** The same for distances over their σ: at least 3, beyond which an error as stated is one in 370. */
export const colourLimitSigmas = (inSigmas: ArrayLike<number>): number => roundLimit(inSigmas, 3);

/** Each distance over its σ; NaN where none is stated. */
export function inSigmas(distance_m: ArrayLike<number>, sigma_m: ArrayLike<number>): Float32Array {
  return Float32Array.from({ length: distance_m.length }, (_, index) => {
    const sigma = sigma_m[index]!;
    return sigma > 0 ? distance_m[index]! / sigma : NaN;
  });
}

function roundLimit(distance: ArrayLike<number>, least: number): number {
  const sizes = Array.from(distance, Math.abs).filter(Number.isFinite).sort((a, b) => a - b);
  const most = Math.max(least, sizes[Math.floor(0.95 * (sizes.length - 1))] ?? 0);
  const power = 10 ** Math.floor(Math.log10(most) + 1e-9);
  const digit = [1, 1.5, 2, 3, 4, 5, 6, 8, 10].find((step) => step * power >= most * (1 - 1e-9)) ?? 10;
  return digit * power;
}

export interface Histogram {
  /** Edges of the bins as a step line needs them, mm. */
  edges_mm: number[];
  percent: number[];
}

/** The share of distances in each of `bins` equal bins between −limit and limit; what is beyond is in the outermost. */
export function histogram(distance_m: ArrayLike<number>, limit_m: number, bins = 40): Histogram {
  const counts = new Array<number>(bins).fill(0);
  for (let index = 0; index < distance_m.length; ++index) {
    const at = Math.floor(((distance_m[index]! / limit_m + 1) / 2) * bins);
    const bin = Math.max(0, Math.min(bins - 1, at));
    counts[bin] = counts[bin]! + 1;
  }
  const share = 100 / Math.max(1, distance_m.length);
  return {
    edges_mm: counts.map((_, bin) => 1e3 * limit_m * ((2 * bin) / bins - 1)).concat(1e3 * limit_m),
    percent: counts.map((count) => count * share).concat((counts[bins - 1] ?? 0) * share),
  };
}
