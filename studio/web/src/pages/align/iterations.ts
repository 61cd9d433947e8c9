// The iterations of a registration, as they come from the server.
import type { Block } from "../../net/block";
import type { Series } from "../../plot/series";
import type { Pose } from "./pose";

export interface Iterations {
  run: number;
  phases: string[];
  poses: Pose[];
  rms_m: number[];
  phase: number[];
  start: number[];
  points: number[];
  inliers: number[];
}

export const noIterations: Iterations = { run: 0, phases: [], poses: [], rms_m: [], phase: [], start: [], points: [], inliers: [] };

const PHASE_WORDS: Record<string, string> = {
  search: "search from anywhere",
  annealing: "from the guess, few points",
  fit: "all points",
  restarts: "other starts, few points",
  comparison: "competing poses, all points",
  guesses: "from other guesses",
  refinement: "with the tracker's drift",
};

export const phaseWords = (name: string): string => PHASE_WORDS[name] ?? name;

/** What is known after a block: a run's next iterations, or those of another run from its beginning. */
export function withBlock(known: Iterations, block: Block): Iterations {
  const { run, first, phases } = block.head as { run: number; first: number; phases: string[] };
  const rms_m = Array.from(block.arrays.rms_m ?? []);
  const poses = rms_m.map((_, index) => Array.from(block.arrays.T_mesh_world!.subarray(7 * index, 7 * index + 7)));
  const base = run === known.run ? known : { ...noIterations, run };
  const at = Math.min(first, base.rms_m.length);
  const joined = (before: number[], name: string) => [...before.slice(0, at), ...Array.from(block.arrays[name] ?? [])];
  return {
    run,
    phases,
    poses: [...base.poses.slice(0, at), ...poses],
    rms_m: joined(base.rms_m, "rms_m"),
    phase: joined(base.phase, "phase"),
    start: joined(base.start, "start"),
    points: joined(base.points, "points"),
    inliers: joined(base.inliers, "inliers"),
  };
}

/** One series of dots a phase, in millimetres over the number of the iteration, from 1. */
export function seriesOf({ phases, phase, rms_m }: Iterations): Series[] {
  return phases.flatMap((name, which) => {
    const x: number[] = [];
    const y: number[] = [];
    phase.forEach((one, index) => {
      if (one !== which || !(rms_m[index]! > 0)) return;
      x.push(index + 1);
      y.push(1e3 * rms_m[index]!);
    });
    const colour = ((which % 8) + 1) as Series["colour"];
    return x.length ? [{ label: phaseWords(name), x, y, kind: "points" as const, colour }] : [];
  });
}

/** The iterations worth seeing one after the other: those from the guess, not those of other starts. */
export function mainLine({ phases, phase, start }: Iterations): number[] {
  const main = new Set(["annealing", "fit", "refinement"].map((name) => phases.indexOf(name)));
  const found = phase.flatMap((one, index) => (main.has(one) && start[index] === 0 ? [index] : []));
  return found.length ? found : phase.map((_, index) => index);
}
