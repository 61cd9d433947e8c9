import { figureGroups, shownFigure } from "./figures";

export interface ComparedRow {
  label: string;
  values: string[];
}

const kLongestWords = 12; // sentences are for each result's own place

/** One row for each figure that any of them has, in the order of the first that has it. */
export function comparedRows(results: Record<string, any>[]): ComparedRow[] {
  const rows = new Map<string, ComparedRow>();
  results.forEach((json, index) => {
    for (const group of figureGroups(json)) {
      for (const figure of group.rows) {
        if (typeof figure.value === "string" && figure.value.length > kLongestWords) continue;
        const key = `${group.title}: ${figure.label}`;
        const row = rows.get(key) ?? { label: figure.label, values: results.map(() => "–") };
        rows.set(key, row);
        row.values[index] = shownFigure(figure);
      }
    }
  });
  return [...rows.values()];
}
