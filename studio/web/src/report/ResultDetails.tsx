import { ConfigTable } from "../measured/ConfigTable";
import { DroppedTable } from "../measured/DroppedTable";
import { figureGroups, figureValue, type MeasuredFigure } from "../measured/measured";
import { Figure } from "../ui/Figure";
import { Figures } from "../ui/Figures";
import type { Result } from "./result";

/** Values (of several results they are side by side elsewhere), what was dropped and why, and the settings of one result. */
export function ResultDetails({ result, named }: { result: Result; named: boolean }) {
  return (
    <>
      {named && <h2 class="report-name">{result.name}</h2>}
      {!named && <FigureGroups figures={result.measured.figures} />}
      <section class="report-drawing" aria-label="Dropped data and the reasons">
        <h2>Dropped data and the reasons</h2>
        <DroppedTable measured={result.measured} />
      </section>
      <details class="report-drawing">
        <summary>Settings</summary>
        <ConfigTable measured={result.measured} />
      </details>
    </>
  );
}

/** What the data did not allow is left out. */
function FigureGroups({ figures }: { figures: readonly MeasuredFigure[] }) {
  return (
    <section class="report-groups" aria-label="Metrics">
      {figureGroups(figures.filter((figure) => figure.value !== null)).map((group) => (
        <section key={group.name} class="report-group">
          <h2>{group.name}</h2>
          <Figures>
            {group.figures.map((figure) => (
              <Figure key={figure.label} label={figure.label} value={figureValue(figure)} error={figure.error} unit={figure.unit} hint={figure.hint} />
            ))}
          </Figures>
        </section>
      ))}
    </section>
  );
}
