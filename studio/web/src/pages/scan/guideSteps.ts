// Which step of the guided first scan comes next.
interface Now {
  open: boolean;
  recorder?: { storing: boolean; segments: readonly unknown[] };
}

/** 0 open, 1 start, 2 stop, 3 wait, 4 done. */
export function stepOf(state: Now | null | undefined, refined: Record<string, unknown> | undefined): number {
  if (!state?.open) return 0;
  if (state.recorder?.storing) return 2;
  if (!state.recorder || state.recorder.segments.length === 0) return 1;
  return refined && refined.recording !== undefined && !refined.failure ? 4 : 3;
}
