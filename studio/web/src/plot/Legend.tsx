import type { Series } from "./series";
import { dark } from "../app/settings";
import { seriesColour } from "./colours";

/** The names of the series with their line; a click hides one. */
export function Legend(props: { series: readonly Pick<Series, "label" | "kind" | "colour" | "dashed">[]; hidden: ReadonlySet<string>; onToggle?(label: string): void }) {
  void dark.value;
  return (
    <ul class="plot-legend" aria-label="Series">
      {props.series.map((one, index) => (
        <li key={one.label}>
          <button
            type="button"
            disabled={!props.onToggle}
            aria-pressed={!props.hidden.has(one.label)}
            title={props.onToggle ? "Show or hide" : undefined}
            onClick={() => props.onToggle?.(one.label)}
          >
            <svg width="18" height="10" viewBox="0 0 18 10" aria-hidden="true">
              {one.kind === "points" ? (
                <circle cx="9" cy="5" r="3" style={{ fill: seriesColour(one.colour, index) }} />
              ) : (
                <path d="M1 5h16" style={{ stroke: seriesColour(one.colour, index), strokeWidth: 2, strokeDasharray: one.dashed ? "4 3" : "none" }} />
              )}
            </svg>
            {one.label}
          </button>
        </li>
      ))}
    </ul>
  );
}
