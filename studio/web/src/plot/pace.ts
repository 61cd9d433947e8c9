/**
 * When to draw something that moves: at most every `least_ms`, and less often where frames come slowly because drawing is dear
 * (WebGL and canvases made in software), so that what comes from the server is not kept waiting.
 */
export class Pace {
  private last_ms = -Infinity;
  private drawn_ms = -Infinity;
  private frame_ms = 16;

  constructor(private readonly least_ms: number) {}

  /** Called at each animation frame with its time; true if it is time to draw. */
  due(now_ms: number): boolean {
    // A frame after a pause of the page states nothing of its cost.
    const step_ms = Math.min(now_ms - this.last_ms, 200);
    if (Number.isFinite(step_ms)) this.frame_ms += 0.1 * (step_ms - this.frame_ms);
    this.last_ms = now_ms;
    return now_ms - this.drawn_ms >= this.period_ms;
  }

  /** Called after it was drawn at this frame. */
  drew(now_ms: number): void {
    this.drawn_ms = now_ms;
  }

  /** A third of the frames as long as they come quickly, and ever fewer. */
  get period_ms(): number {
    return this.frame_ms < 25 ? this.least_ms : Math.max(this.least_ms, this.frame_ms * Math.min(12, this.frame_ms / 6));
  }
}
