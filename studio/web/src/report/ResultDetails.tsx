import { ConfigTable } from "../measured/ConfigTable";
import { DroppedTable } from "../measured/DroppedTable";
import { Figure } from "../ui/Figure";
import { Figures } from "../ui/Figures";
import { figureGroups } from "./figures";
import type { Result } from "./result";

/** Figures (of several results they stand side by side elsewhere), what was dropped and why, and the settings of one result. */
export function ResultDetails({ result, named }: { result: Result; named: boolean }) {
  return (
    <>
      {named && <h2 class="report-name">{result.name}</h2>}
      {!named && <FigureGroups json={result.json} />}
      <section class="report-drawing" aria-label="What was dropped and why">
        <h2>What was dropped and why</h2>
        <DroppedTable measured={result.measured} />
      </section>
      <details class="report-drawing">
        <summary>Settings</summary>
        <ConfigTable measured={result.measured} />
      </details>
    </>
  );
}

function FigureGroups({ json }: { json: Record<string, any> }) {
  return (
    <section class="report-groups" aria-label="Figures">
      {figureGroups(json).map((group) => (
        <section key={group.title} class="report-group">
          <h2>{group.title}</h2>
          <Figures>
            {group.rows.map((row) => (
              <Figure key={row.label} {...row} />
            ))}
          </Figures>
        </section>
      ))}
    </section>
  );
}
