import { readFileSync } from "node:fs";
import { expect, test } from "vitest";

const css = readFileSync(new URL("../src/style/tokens.css", import.meta.url), "utf8");

function tokens(selector: string): Record<string, string> {
  const body = css.slice(css.indexOf(selector)).split("}")[0]!;
  return Object.fromEntries([...body.matchAll(/--([\w-]+):\s*(#[0-9a-f]{6});/g)].map(([, name, colour]) => [name, colour]));
}

/** Relative luminance and contrast as in WCAG 2.2. */
function luminance(colour: string): number {
  const [r, g, b] = [1, 3, 5]
    .map((at) => parseInt(colour.slice(at, at + 2), 16) / 255)
    .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4)) as [number, number, number];
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
function contrast(a: string, b: string): number {
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y) as [number, number];
  return (high + 0.05) / (low + 0.05);
}

const grounds = ["back", "panel", "raised", "sunken", "accent-soft", "bad-soft", "warn-soft", "view-back"];
const words = ["text-1", "text-2", "accent", "good", "warn", "bad"];
const series = [1, 2, 3, 4, 5, 6, 7, 8].map((index) => `series-${index}`);
const kWords = 4.5;
const kShapes = 3;

for (const theme of ["light", "dark"]) {
  const colours = tokens(`:root[data-theme="${theme}"]`);

  test(`${theme}: both themes have the same tokens`, () => {
    expect(Object.keys(colours).sort()).toEqual(Object.keys(tokens(`:root[data-theme="light"]`)).sort());
    expect(Object.keys(colours).length).toBeGreaterThan(30);
  });

  test.each(words.flatMap((word) => grounds.map((ground) => [word, ground])))(`${theme}: words in %s on %s`, (word, ground) =>
    expect(contrast(colours[word!]!, colours[ground!]!)).toBeGreaterThanOrEqual(kWords),
  );

  test.each([
    ["on-accent", "accent"],
    ["on-bad", "bad"],
  ])(`${theme}: words in %s on %s`, (word, ground) => expect(contrast(colours[word]!, colours[ground]!)).toBeGreaterThanOrEqual(kWords));

  test.each(series.flatMap((line) => ["panel", "back", "view-back"].map((ground) => [line, ground])))(`${theme}: %s on %s`, (line, ground) =>
    expect(contrast(colours[line!]!, colours[ground!]!)).toBeGreaterThanOrEqual(kWords),
  );

  test.each(
    ["line-strong", "focus", "axis-x", "axis-y", "axis-z"].flatMap((shape) => ["back", "panel", "raised", "view-back"].map((ground) => [shape, ground])),
  )(`${theme}: the shape of %s on %s`, (shape, ground) =>
    expect(contrast(colours[shape!]!, colours[ground!]!)).toBeGreaterThanOrEqual(kShapes),
  );
}
