import { VerdictList } from "../measured/VerdictList";
import { verdictsOf, verdictWord } from "../measured/verdicts";
import { Comparison } from "./Comparison";
import { OneResult } from "./OneResult";
import { Overlaid } from "./Overlaid";
import { ResultDetails } from "./ResultDetails";
import type { Result } from "./result";

/** The page: plots of all results together, then each one's values, problems and settings. */
export function Report({ results }: { results: Result[] }) {
  const one = results.length === 1 ? results[0]! : null;
  return (
    <main class="report">
      <header class="report-head">
        <h1>{one ? one.name : `${results.length} results`}</h1>
        <p>{one ? subtitle(one) : results.map((result) => result.name).join(", ")}</p>
      </header>
      {results.map((result) => (
        <Verdict key={result.name} result={result} named={!one} />
      ))}
      {one ? <OneResult measured={one.measured} /> : <Overlaid results={results} />}
      {!one && <Comparison results={results} />}
      {results.map((result) => (
        <ResultDetails key={result.name} result={result} named={!one} />
      ))}
      <footer class="report-foot">
        <p>Measured by Asperity {versions(results)}. The files next to this report contain the same values in full; `asperity report` makes the report from them.</p>
      </footer>
    </main>
  );
}

function subtitle({ json }: Result): string {
  return [json.object, json.probe && `probe ${json.probe}`, json.method && `method ${json.method}`].filter(Boolean).join(" · ");
}

function Verdict({ result, named }: { result: Result; named: boolean }) {
  const verdicts = verdictsOf(result.json);
  const word = verdictWord(verdicts);
  if (word === "valid" && named) return null;
  return (
    <div class={word === "valid" ? "report-verdict" : "report-verdict report-distrust"} role="status">
      {named && <strong>{result.name}: </strong>}
      <VerdictList verdicts={verdicts} />
    </div>
  );
}

function versions(results: Result[]): string {
  return [...new Set(results.map((result) => String(result.json.asperity ?? "of unknown version")))].join(", ");
}
