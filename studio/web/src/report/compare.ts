import { figureGroups, figureWords, type MeasuredFigure } from "../measured/measured";

export interface ComparedRow {
  group: string;
  label: string;
  values: string[];
}

const kLongestWords = 12; // sentences are for each result's own place

/** One row for each value that any result has, in the order of the first that has it. */
export function comparedRows(results: readonly (readonly MeasuredFigure[])[]): ComparedRow[] {
  const rows = new Map<string, ComparedRow>();
  results.forEach((figures, index) => {
    for (const { name: group, figures: members } of figureGroups(figures)) {
      for (const figure of members) {
        if (figure.value === null || (typeof figure.value === "string" && figure.value.length > kLongestWords)) continue;
        const key = `${group}: ${figure.label}`;
        const row = rows.get(key) ?? { group, label: figure.label, values: results.map(() => "–") };
        rows.set(key, row);
        row.values[index] = figureWords(figure);
      }
    }
  });
  return [...rows.values()];
}
