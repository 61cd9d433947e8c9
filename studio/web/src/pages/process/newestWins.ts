// One question at a time: while one is being answered only the newest of those that follow is kept. So a slider that is
// dragged always sees answers, each to the newest setting that there was when the one before came in. A question that
// takes long gives way at once: the server drops it for the newer one.

export class NewestWins {
  private running = 0;
  private startedAt_ms = 0;
  private next: (() => Promise<void>) | null = null;
  private serial = 0;

  constructor(
    private readonly patience_ms: number,
    private readonly now_ms: () => number = () => performance.now(),
  ) {}

  /** Asks now, or as soon as the one before is answered. `work` is informed whether its answer is still the newest. */
  ask(work: (isNewest: () => boolean) => Promise<void>): void {
    const mine = ++this.serial;
    const begin = () => work(() => mine === this.serial);
    if (this.running > 0 && this.now_ms() - this.startedAt_ms < this.patience_ms) {
      this.next = begin;
      return;
    }
    this.next = null;
    void this.run(begin);
  }

  private async run(begin: () => Promise<void>): Promise<void> {
    ++this.running;
    this.startedAt_ms = this.now_ms();
    try {
      await begin();
    } finally {
      --this.running;
      const { next } = this;
      this.next = null;
      if (next) void this.run(next);
    }
  }
}
