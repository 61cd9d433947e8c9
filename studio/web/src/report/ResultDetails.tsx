import { Table } from "../ui/Table";
import { Figure } from "../ui/Figure";
import { Figures } from "../ui/Figures";
import { figureGroups } from "./figures";
import { flatSettings, type Problem, type Result } from "./result";

/** Figures (of several results they stand side by side elsewhere), what was dropped and why, and the settings of one result. */
export function ResultDetails({ result, named }: { result: Result; named: boolean }) {
  const problems: Problem[] = Array.isArray(result.json.problems) ? result.json.problems : [];
  return (
    <>
      {named && <h2 class="report-name">{result.name}</h2>}
      {!named && <FigureGroups json={result.json} />}
      <section class="report-drawing" aria-label="What was dropped or looked wrong">
        <h2>What was dropped or looked wrong</h2>
        {problems.length === 0 ? (
          <p class="report-note">Nothing.</p>
        ) : (
          <Table<Problem>
            caption="What was dropped or looked wrong"
            columns={[
              { key: "count", label: "How often", numeric: true, cell: (row) => String(row.count) },
              { key: "message", label: "What and why" },
              { key: "kind", label: "Kind", cell: (row) => <code>{row.kind}</code> },
            ]}
            rows={problems}
          />
        )}
      </section>
      <details class="report-drawing">
        <summary>Settings</summary>
        <Table<[string, string]>
          caption="Settings, resolved"
          columns={[
            { key: "name", label: "Setting", cell: ([name]) => <code>{name}</code> },
            { key: "value", label: "Value", cell: ([, value]) => value },
          ]}
          rows={flatSettings(result.json.config ?? {})}
        />
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
