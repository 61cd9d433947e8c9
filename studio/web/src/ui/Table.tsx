import type { ComponentChildren } from "preact";
import { useRef } from "preact/hooks";
import { shownRows, TableSave } from "../save/TableSave";
import { floored, number } from "./format";

export interface Column<Row> {
  key: string;
  label: string;
  /** The label is for screen readers alone, as above buttons. */
  unseen?: boolean;
  unit?: string;
  /** What a cell shows; without it row[key], numbers with four digits. */
  cell?(row: Row, index: number): ComponentChildren;
  numeric?: boolean;
}

export interface TableProps<Row> {
  /** What the table holds; read out. */
  caption: string;
  columns: readonly Column<Row>[];
  rows: readonly Row[];
  rowKey?(row: Row, index: number): string | number;
  /** Makes rows choosable, by click, Enter and Space. */
  onChoose?(row: Row, index: number): void;
  chosen?(row: Row, index: number): boolean;
  /** Shown instead of rows where there are none. */
  empty?: string;
  /** With a button that saves or copies what it shows. */
  savable?: boolean;
  testId?: string;
}

/** Rows and columns; numbers to the right. */
export function Table<Row>({ caption, columns, rows, rowKey, onChoose, chosen, empty = "Nothing yet.", savable, testId }: TableProps<Row>) {
  const table = useRef<HTMLTableElement>(null);
  const frame = (
    <div class="table-frame" data-testid={testId} role="region" aria-label={caption} tabIndex={0}>
      <table ref={table}>
        <caption class="visually-hidden">{caption}</caption>
        <thead>
          <tr>
            {columns.map((column) => (
              <th key={column.key} scope="col" class={column.numeric ? "numeric" : undefined}>
                {column.unseen ? <span class="visually-hidden">{column.label}</span> : column.label}
                {column.unit && <span class="unit"> {column.unit}</span>}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {rows.length === 0 && (
            <tr>
              <td colSpan={columns.length} class="empty">
                {empty}
              </td>
            </tr>
          )}
          {rows.map((row, index) => (
            <tr
              key={rowKey ? rowKey(row, index) : index}
              class={onChoose ? "choosable" : undefined}
              tabIndex={onChoose ? 0 : undefined}
              aria-selected={onChoose ? (chosen?.(row, index) ?? false) : undefined}
              onClick={onChoose && (() => onChoose(row, index))}
              onKeyDown={
                onChoose &&
                ((event) => {
                  if (event.target !== event.currentTarget || (event.key !== "Enter" && event.key !== " ")) return;
                  event.preventDefault();
                  onChoose(row, index);
                })
              }
            >
              {columns.map((column) => (
                <td key={column.key} class={column.numeric ? "numeric" : undefined}>
                  {content(column, row, index)}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
  if (!savable || rows.length === 0) return frame;
  return (
    <div class="table-savable">
      <TableSave caption={caption} rows={() => shownRows(table.current!)} testId={testId && `${testId}-save`} />
      {frame}
    </div>
  );
}

function content<Row>(column: Column<Row>, row: Row, index: number): ComponentChildren {
  if (column.cell) return column.cell(row, index);
  const value = (row as Record<string, unknown>)[column.key];
  return typeof value === "number" ? number(floored(value, column.unit ?? "")) : ((value ?? "–") as ComponentChildren);
}
