import type { SeriesColour } from "./series";

/** The value of a CSS variable of the theme that is shown. */
export function themeColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

export function seriesColour(colour: SeriesColour | undefined, index: number): string {
  const name = colour ?? (((index % 8) + 1) as SeriesColour);
  if (typeof name === "number") return themeColour(`--series-${name}`);
  return themeColour(name === "muted" ? "--text-2" : `--${name}`);
}

/** A "#rrggbb" colour with an opacity from 0 to 1. */
export const faded = (colour: string, opacity: number): string =>
  colour + Math.round(255 * opacity).toString(16).padStart(2, "0");
