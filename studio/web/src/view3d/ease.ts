/**
 * When the next picture may be drawn: after an expensive picture the page has as much time for everything else, such as data from the
 * server, to keys, and to the heartbeat of the force, which ends when it is silent for half a second.
 */
export class Ease {
  private free_ms = -Infinity;

  due(now_ms: number): boolean {
    return now_ms >= this.free_ms;
  }

  /** Called when a picture was begun, and when the page was free again. */
  drew(begun_ms: number, ended_ms: number): void {
    const cost_ms = Math.max(0, ended_ms - begun_ms);
    this.free_ms = ended_ms + (cost_ms > kCheap_ms ? Math.min(cost_ms, kLongest_ms) : 0);
  }
}

/** Two frames of a screen. */
const kCheap_ms = 33;
/** A page that was asleep is not to wait for ever. */
const kLongest_ms = 1000;
