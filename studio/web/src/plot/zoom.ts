// Moving along an axis by key.

export interface Range {
  min: number;
  max: number;
}

export const isAllOf = (shown: Range, all: Range): boolean => shown.min <= all.min && shown.max >= all.max;

/** What is shown of new data: what was zoomed into while it is there, else all, however far it has grown. */
export function rangeAfter(shown: Range, before: Range, all: Range): Range {
  const isOut = shown.min >= all.max || shown.max <= all.min;
  return isOut || isAllOf(shown, before) ? all : shown;
}

/** The range after a key, or null where the key means nothing: + and − zoom, arrows move, 0 and Home show all. */
export function zoomed(range: Range, all: Range, key: string, logarithmic: boolean): Range | null {
  const to = logarithmic ? Math.log : (value: number) => value;
  const back = logarithmic ? Math.exp : (value: number) => value;
  const low = to(range.min);
  const width = to(range.max) - low;
  const moved = (from: number, size: number): Range => {
    const lowest = to(all.min);
    const highest = to(all.max);
    const kept = Math.min(size, highest - lowest);
    const start = Math.min(Math.max(from, lowest), highest - kept);
    return { min: back(start), max: back(start + kept) };
  };
  switch (key) {
    case "+":
    case "=":
      return moved(low + width / 4, width / 2);
    case "-":
      return moved(low - width / 2, width * 2);
    case "ArrowLeft":
      return moved(low - width / 5, width);
    case "ArrowRight":
      return moved(low + width / 5, width);
    case "0":
    case "Home":
      return { ...all };
    default:
      return null;
  }
}
