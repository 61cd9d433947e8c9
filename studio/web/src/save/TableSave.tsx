import { SaveMenu } from "../ui/SaveMenu";
import { copyText, csvLine, fileName, saveFile } from "./files";

/** A table's rows as CSV: a file, or the clipboard. `rows` begins with the names of the columns. */
export function TableSave({ caption, rows, testId }: { caption: string; rows(): readonly (readonly string[])[]; testId?: string }) {
  const csv = () => rows().map(csvLine).join("");
  return (
    <SaveMenu
      what={caption}
      testId={testId}
      choices={[
        { words: "Save as CSV", run: () => saveFile(`${fileName(caption)}.csv`, csv(), "text/csv") },
        { words: "Copy the rows", run: () => copyText(csv()) },
      ]}
    />
  );
}

/** What a table shows, cell by cell. */
export const shownRows = (table: HTMLTableElement): string[][] =>
  [...table.rows].map((row) => [...row.cells].map((cell) => (cell.textContent ?? "").replace(/\s+/g, " ").trim()));
