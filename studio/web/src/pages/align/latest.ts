// Calls that follow a drag: one at a time, and of those that wait only the newest.

export interface Latest<Argument> {
  (argument: Argument): void;
  /** True while one is under way. */
  busy(): boolean;
}

/** `work` for the newest argument as soon as the one before has ended; `idle` after the last. */
export function latest<Argument>(work: (argument: Argument) => Promise<unknown>, idle: () => void = () => {}): Latest<Argument> {
  let running = false;
  let waiting: { argument: Argument } | null = null;
  const begin = (argument: Argument): void => {
    running = true;
    work(argument).then(next, next);
  };
  const next = (): void => {
    running = false;
    if (!waiting) return idle();
    const { argument } = waiting;
    waiting = null;
    begin(argument);
  };
  const follow = (argument: Argument): void => {
    if (running) waiting = { argument };
    else begin(argument);
  };
  return Object.assign(follow, { busy: () => running });
}
