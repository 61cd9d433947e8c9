import { millimetres } from "../../ui/format";
import type { RunResult } from "./alignState";

/** The verdict in a sentence or two: what it rests on, or what is wrong and what to do. The server's own words say more. */
export function verdictWords(found: Pick<RunResult, "converged" | "trustworthy" | "ambiguous" | "rms_m" | "points" | "outliers" | "runner_up">): string {
  const onMesh = found.points - found.outliers;
  const fit = `${onMesh} of ${found.points} points are on the mesh, within ${millimetres(found.rms_m, 2)} RMS.`;
  if (found.trustworthy) return fit;
  if (found.ambiguous) {
    const apart = found.runner_up?.distance_m == null ? "" : `, ${millimetres(found.runner_up.distance_m, 3)} away,`;
    return `Another pose${apart} fits as well. Move the path nearer by hand or by pairs and register from here, or scan a longer path.`;
  }
  if (!found.converged) return `The registration did not converge. ${fit} Move the path nearer by hand or by pairs, then register from here.`;
  return `${fit} Check that it is the right mesh, in the right unit.`;
}
