// Numbers as people read them: few digits, a proper minus, a narrow space before the unit, at which no line is broken.

const THIN = "\u202f";
const MINUS = "\u2212";
const NOTHING = "–";

/** A number with `digits` significant digits; "–" if it is not one. */
export function number(value: number | null | undefined, digits = 4): string {
  if (value == null || !Number.isFinite(value)) return NOTHING;
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return power(value, digits);
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(Number(size.toPrecision(digits)))));
  return minus(value.toFixed(Math.min(decimals, 12)));
}

/** A number with a fixed count of decimals, for what changes while one looks. */
export function fixed(value: number | null | undefined, decimals: number): string {
  if (value == null || !Number.isFinite(value)) return NOTHING;
  const text = value.toFixed(decimals);
  return minus(Number(text) === 0 ? text.replace("-", "") : text);
}

/** Less than this is nothing in its unit: a length under a nanometre is rounding, not surface. */
const FLOORS: Record<string, number> = { m: 1e-9, mm: 1e-6, µm: 1e-3, N: 1e-6, "m/s": 1e-9, "mm/s": 1e-6, "°": 1e-6, rad: 1e-8, s: 1e-9, ms: 1e-6, "%": 1e-6 };

/** The value, or 0 if it is too small to mean anything in its unit. */
export const floored = (value: number, unit: string): number => (Math.abs(value) < (FLOORS[unit] ?? 0) ? 0 : value);

/** What is written, and its unit, on one line. */
export const withUnit = (text: string, unit: string): string => (unit && text !== NOTHING ? `${text}${gap(unit)}${unit}` : text);

/** A number and its unit. */
export function quantity(value: number | null | undefined, unit: string, digits = 4): string {
  return withUnit(number(value == null ? value : floored(value, unit), digits), unit);
}

/** "12.34 ± 0.05 mm": the error with two significant digits, the value with as many decimals. */
export function withError(value: number | null | undefined, error: number | null | undefined, unit = ""): string {
  if (value == null || !Number.isFinite(value)) return NOTHING;
  if (error == null || !Number.isFinite(error) || floored(error, unit) <= 0) return quantity(value, unit);
  const exponent = Math.floor(Math.log10(Number(error.toPrecision(2))));
  const decimals = 1 - exponent;
  const both =
    decimals < 0 || decimals > 9
      ? `${number(value)}${THIN}±${THIN}${number(error, 2)}`
      : `${fixed(value, decimals)}${THIN}±${THIN}${fixed(error, decimals)}`;
  return withUnit(both, unit);
}

export const millimetres = (value_m: number | null | undefined, digits = 4) => quantity(scaled(value_m, 1e3), "mm", digits);
export const micrometres = (value_m: number | null | undefined, digits = 4) => quantity(scaled(value_m, 1e6), "µm", digits);
export const newtons = (value_N: number | null | undefined, digits = 3) => quantity(value_N, "N", digits);
export const millimetresPerSecond = (value_m_s: number | null | undefined, digits = 3) => quantity(scaled(value_m_s, 1e3), "mm/s", digits);
export const degrees = (value_rad: number | null | undefined, digits = 3) => quantity(scaled(value_rad, 180 / Math.PI), "°", digits);
export const seconds = (value_s: number | null | undefined, digits = 3) => quantity(value_s, "s", digits);
export const percent = (fraction: number | null | undefined, digits = 3) => quantity(scaled(fraction, 100), "%", digits);

/** A delay in ms, or in s where it is long; without decimals that nobody reads. */
export const delay = (value_ms: number | null | undefined): string =>
  (value_ms ?? NaN) < 1000 ? withUnit(fixed(value_ms, 0), "ms") : withUnit(fixed(scaled(value_ms, 1e-3), 1), "s");

/** A length in the unit that suits its size: µm, mm or m. */
export function length(value_m: number | null | undefined, digits = 4): string {
  const size = Math.abs(value_m ?? 0);
  if (floored(size, "m") > 0 && size < 1e-3) return micrometres(value_m, digits);
  return size < 1 ? millimetres(value_m, digits) : quantity(value_m, "m", digits);
}

const scaled = (value: number | null | undefined, factor: number) => (value == null ? value : value * factor);
const minus = (text: string) => text.replace("-", MINUS);
const gap = (unit: string) => (unit.startsWith("°") && unit.length === 1 ? "" : THIN);

const SUPERSCRIPTS: Record<string, string> = { "-": "⁻", ...Object.fromEntries([..."⁰¹²³⁴⁵⁶⁷⁸⁹"].map((sign, digit) => [String(digit), sign])) };

/** A whole number in raised digits. */
export const superscript = (exponent: number): string => [...String(exponent)].map((sign) => SUPERSCRIPTS[sign]).join("");

function power(value: number, digits: number): string {
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e") as [string, string];
  return `${minus(mantissa)}${THIN}×${THIN}10${superscript(Number(exponent))}`;
}
