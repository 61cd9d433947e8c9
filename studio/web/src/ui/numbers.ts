// Numbers as people type them.

/** A number that may be typed with a comma or a proper minus; null if it is not one. */
export function parseNumber(text: string): number | null {
  const plain = text.trim().replace(/\u2212/g, "-").replace(",", ".");
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain)) return null;
  const value = Number(plain);
  return Number.isFinite(value) ? value : null;
}

/** A number for a field: short, but never shorter than six digits if it has them. */
export function shownNumber(value: number): string {
  if (!Number.isFinite(value)) return "";
  return String(Number(value.toPrecision(6)));
}
