import { useMemo } from "preact/hooks";
import { dark } from "../app/settings";
import { seriesColour } from "../plot/colours";
import { dotsFromPoints, lineFromPoints } from "../view3d/helpers";
import type { View } from "../view3d/View";
import { Viewport } from "../view3d/Viewport";
import { Drawing } from "./ProfilePlots";
import type { Result } from "./result";

/** The tip's way in the world frame, where the path was kept. */
export function PathView({ results }: { results: Result[] }) {
  const kept = useMemo(() => results.filter((result) => result.path_m.length >= 6), [results]);
  if (kept.length === 0) return null;
  const onReady = (view: View) => {
    kept.forEach((result) => {
      const colour = seriesColour(undefined, results.indexOf(result));
      view.add(lineFromPoints(result.path_m, colour));
      view.add(dotsFromPoints(result.path_m.slice(0, 3), colour, 9));
    });
    view.fit();
  };
  const drawn = kept.reduce((sum, result) => sum + result.path_m.length / 3, 0);
  const measured = kept.reduce((sum, result) => sum + result.pathPoints, 0);
  const note = drawn < measured ? ` Drawn are ${drawn.toLocaleString("en")} of ${measured.toLocaleString("en")} points.` : "";
  return (
    <Drawing title="The tip's path" note={`In the tracker's frame; a dot is where it begins.${note}`} tall>
      <Viewport key={String(dark.value)} label="The tip's path in three dimensions" onReady={onReady} />
    </Drawing>
  );
}
