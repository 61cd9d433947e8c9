// What the command palette finds.

export interface Command {
  title: string;
  /** What kind of thing it is: "Page", "File", "Action", "Document". */
  kind: string;
  /** Its key, if it has one. */
  key?: string;
  run(): unknown;
}

const kMostShown = 12;

/** Commands that hold all words that were typed; those that begin with it first. */
export function found(commands: readonly Command[], typed: string): Command[] {
  const words = typed.toLowerCase().split(/\s+/).filter(Boolean);
  const whole = words.join(" ");
  const rank = ({ title }: Command): number => {
    const text = title.toLowerCase();
    if (text.startsWith(whole)) return 0;
    return text.split(/[\s/]+/).some((part) => words[0] !== undefined && part.startsWith(words[0])) ? 1 : 2;
  };
  return commands
    .filter(({ title, kind }) => words.every((word) => `${title} ${kind}`.toLowerCase().includes(word)))
    .map((command, index) => ({ command, index, rank: rank(command) }))
    .sort((a, b) => a.rank - b.rank || a.index - b.index)
    .slice(0, kMostShown)
    .map(({ command }) => command);
}
