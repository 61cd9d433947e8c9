// What flows find out. A check that fails throws, naming what was there.
import { isDeepStrictEqual } from "node:util";

const kPoll_ms = 50;
const kPatience_ms = Number(process.env.ASPERITY_E2E_TIMEOUT_MS ?? 90_000);

export function equal(value, expected, what) {
  if (!isDeepStrictEqual(value, expected)) throw new Error(`${what}: ${JSON.stringify(value)} where ${JSON.stringify(expected)} was expected`);
}

export function ok(value, what) {
  if (!value) throw new Error(`not so: ${what}`);
}

export function near(value, expected, tolerance, what) {
  if (!(Math.abs(value - expected) <= tolerance)) throw new Error(`${what}: ${value} where ${expected} ± ${tolerance} was expected`);
}

/** Waits until `condition` gives something true, and gives that. */
export async function until(condition, what, patience_ms = kPatience_ms) {
  const end = Date.now() + patience_ms;
  for (;;) {
    const value = await condition();
    if (value) return value;
    if (Date.now() > end) throw new Error(`waited in vain: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, kPoll_ms));
  }
}

/** The first number in a text such as "2.50 mm" or "−3 µm". */
export function numberIn(text) {
  const found = /[-−]?\d+(?:\.\d+)?/.exec(text ?? "");
  if (!found) throw new Error(`no number in "${text}"`);
  return Number(found[0].replace("−", "-"));
}
