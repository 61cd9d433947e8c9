/** Two measuring cursors of a plot, at values of x. */
export interface Cursors {
  a: number;
  b: number;
}

export type CursorName = keyof Cursors;
