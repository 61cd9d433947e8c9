// Round values for an axis.

const kSteps = [1, 2, 5, 10];

/** Multiples of 1, 2 or 5 times a power of ten within the range, about `count` of them. */
export function linearTicks(low: number, high: number, count: number): number[] {
  if (!(high > low)) return [low];
  const rough = (high - low) / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * kSteps.find((one) => one * power >= rough * (1 - 1e-9))!;
  const out: number[] = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) out.push(i * step);
  return out;
}

/** Powers of ten within the range; of a range without two of them its ends' linear ticks. */
export function decadeTicks(low: number, high: number, count: number): number[] {
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  if (last - first < 1) return linearTicks(low, high, Math.min(count, 4)).filter((value) => value > 0);
  const each = Math.max(1, Math.ceil((last - first) / Math.max(1, count)));
  const out: number[] = [];
  for (let exponent = first; exponent <= last; exponent += each) out.push(10 ** exponent);
  return out;
}
