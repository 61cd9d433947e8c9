// Distances of the path to the mesh: their colours and their histogram.

/** Dark blue to yellow, as bright as large, told apart by the colour-blind (after cividis). */
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

/** Colours of distances up to `limit_m`, in the linear light that three.js wants. */
export function residualColours(distance_m: ArrayLike<number>, limit_m: number): Float32Array {
  const out = new Float32Array(3 * distance_m.length);
  for (let index = 0; index < distance_m.length; ++index) {
    const colour = rampColour(Math.abs(distance_m[index]!) / limit_m);
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
export function colourLimit_m(distance_m: ArrayLike<number>): number {
  const sizes = Array.from(distance_m, Math.abs).sort((a, b) => a - b);
  const most = Math.max(1e-5, sizes[Math.floor(0.95 * (sizes.length - 1))] ?? 0);
  const power = 10 ** Math.floor(Math.log10(most) + 1e-9);
  const digit = [1, 1.5, 2, 3, 4, 5, 6, 8, 10].find((step) => step * power >= most * (1 - 1e-9)) ?? 10;
  return digit * power;
}

export interface Histogram {
  /** Edges of the bins as a step line wants them, mm. */
  edges_mm: number[];
  percent: number[];
}

/** The share of distances in each of `bins` equal bins between −limit and limit; what lies beyond is in the outermost. */
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
