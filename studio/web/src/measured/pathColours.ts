// Colours along a path by a quantity: from dark blue over green to yellow, brighter for more, so that they differ also
// without colour.

export interface ColourRange {
  low: number;
  high: number;
}

const STOPS: [number, number, number][] = [
  [0.267, 0.005, 0.329],
  [0.229, 0.322, 0.546],
  [0.128, 0.567, 0.551],
  [0.369, 0.789, 0.383],
  [0.993, 0.906, 0.144],
];
const GREY: [number, number, number] = [0.5, 0.5, 0.5];

/** The range that all but the outermost hundredth at either end lie in; null without values. */
export function colourRange(values: ArrayLike<number>): ColourRange | null {
  const sorted = Float64Array.from(values).filter(Number.isFinite).sort();
  if (sorted.length === 0) return null;
  const at = (share: number) => sorted[Math.round(share * (sorted.length - 1))]!;
  const [low, high] = [at(0.01), at(0.99)];
  return high > low ? { low, high } : { low: low - 0.5, high: low + 0.5 };
}

/** Three numbers from 0 to 1 a value, grey where there is none. */
export function pathColours(values: ArrayLike<number>, range: ColourRange): Float32Array {
  const out = new Float32Array(3 * values.length);
  for (let i = 0; i < values.length; ++i) out.set(colourAt((values[i]! - range.low) / (range.high - range.low)), 3 * i);
  return out;
}

export function colourAt(share: number): [number, number, number] {
  if (!Number.isFinite(share)) return GREY;
  const place = Math.min(1, Math.max(0, share)) * (STOPS.length - 1);
  const below = Math.min(STOPS.length - 2, Math.floor(place));
  const part = place - below;
  const [a, b] = [STOPS[below]!, STOPS[below + 1]!];
  return [0, 1, 2].map((c) => a[c]! + part * (b[c]! - a[c]!)) as [number, number, number];
}

/** As CSS. */
export const cssColour = (share: number): string => `rgb(${colourAt(share).map((c) => Math.round(255 * c)).join(",")})`;
