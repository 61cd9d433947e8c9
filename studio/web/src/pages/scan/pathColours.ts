// Colours of the tip's path: grey in the air, by the force in contact.

export type Rgb = [red: number, green: number, blue: number];

const STEPS: { dark: Rgb[]; light: Rgb[] } = {
  dark: [
    [0.3, 0.62, 0.98],
    [0.3, 0.86, 0.62],
    [0.98, 0.8, 0.28],
    [1.0, 0.45, 0.35],
  ],
  light: [
    [0.02, 0.33, 0.72],
    [0.02, 0.46, 0.28],
    [0.68, 0.45, 0.0],
    [0.72, 0.1, 0.1],
  ],
};
const AIR: { dark: Rgb; light: Rgb } = { dark: [0.42, 0.47, 0.5], light: [0.62, 0.66, 0.69] };
export const strongest_N = 3;

/** 0 to `strongest_N` from blue over green and yellow to red; `state` 0 is in the air. */
export function pathColour(force_N: number, state: number, dark: boolean): Rgb {
  const theme = dark ? "dark" : "light";
  if (state === 0) return AIR[theme];
  const steps = STEPS[theme];
  const at = (Math.min(1, Math.max(0, Number.isFinite(force_N) ? force_N / strongest_N : 0)) * (steps.length - 1)) as number;
  const low = Math.min(steps.length - 2, Math.floor(at));
  const share = at - low;
  return [0, 1, 2].map((channel) => steps[low]![channel]! * (1 - share) + steps[low + 1]![channel]! * share) as Rgb;
}

export const cssColour = (colour: Rgb): string => `rgb(${colour.map((channel) => Math.round(255 * channel)).join(" ")})`;
