import { TableSave } from "../save/TableSave";
import { Figure } from "../ui/Figure";
import { Figures } from "../ui/Figures";
import { figureGroups, figureRows, figureValue, type MeasuredFigure } from "./measured";

/** Values under their groups, each with unit and uncertainty. `groups` chooses some. */
export function FiguresTable({ figures, groups }: { figures: readonly MeasuredFigure[]; groups?: readonly string[] }) {
  const shown = figureGroups(figures).filter((group) => !groups || groups.includes(group.name));
  return (
    <div class="measured-figures" data-testid="figures">
      <TableSave caption="Metrics" rows={() => figureRows(shown.flatMap((group) => group.figures))} testId="figures-save" />
      {shown.map((group) => (
        <section key={group.name}>
          <h3>{group.name}</h3>
          <Figures>
            {group.figures.map((figure) => (
              <Figure key={figure.label} label={figure.label} value={figureValue(figure)} error={figure.error} unit={figure.unit} hint={figure.hint || figure.key || undefined} />
            ))}
          </Figures>
        </section>
      ))}
    </div>
  );
}
