import { useEffect, useState } from "preact/hooks";
import { call, link } from "../../net/connection";
import { Plot } from "../../plot/Plot";
import { attempt, Button } from "../../ui/Button";
import { FilePicker } from "../../ui/FilePicker";
import { fixed, seconds } from "../../ui/format";
import { Panel } from "../../ui/Panel";
import { Select } from "../../ui/Select";
import { Table } from "../../ui/Table";
import { say } from "../../ui/toast";
import { answersWords, parameterWords, shareWords, stimulusName, thresholdWords, trackSeries, worthWords, type PairShare, type Rating, type StudyResults, type Track } from "./study";
import { studyStatus } from "./studyStore";

/** What the log of a session gives. */
export function ResultsView() {
  const last = studyStatus.value?.last_log ?? "";
  const [chosen, setChosen] = useState<string | null>(null);
  const [results, setResults] = useState<StudyResults | null>(null);
  const log = chosen ?? last;
  useEffect(() => setChosen(null), [last]);
  useEffect(() => {
    setResults(null);
    if (!log || link.value !== "open") return;
    let newest = true;
    void attempt(async () => {
      const found = await call<StudyResults>("study.results", { log });
      if (newest) setResults(found);
    });
    return () => void (newest = false);
  }, [log, link.value]);
  const write = async () => {
    const { name } = await call<{ name: string }>("study.export", { log });
    say(`The results are in ${name}.`);
  };
  return (
    <Panel title="Results" grow testId="study-results">
      <div class="study-log">
        <FilePicker label="Log" kinds={["study-log"]} value={log} none="None" onChange={setChosen} testId="study-log" />
        <Button onClick={write} disabled={!results} testId="study-export">
          Write the results
        </Button>
        {results && !results.whole && (
          <Button onClick={() => call("study.continue", { log })} testId="study-continue">
            Continue this session
          </Button>
        )}
      </div>
      {results ? <Results results={results} /> : <p class="empty">{log ? "Reading …" : "Set up a study at the left and begin, or choose the log of a session."}</p>}
    </Panel>
  );
}

function Results({ results }: { results: StudyResults }) {
  return (
    <>
      <p data-testid="study-summary">
        {results.question} Participant {results.participant}, run {results.run}: {answersWords(results.answers)}, {results.whole ? "complete" : "not complete yet"}; median response time{" "}
        {seconds(results.median_response_s)} of touching. {results.left && `Answers “left”: ${shareWords(results.left)}.`}
      </p>
      {results.problems.map((problem) => (
        <p key={problem} class="field-hint">
          {problem}.
        </p>
      ))}
      {results.method === "pairs" && <Pairs results={results} />}
      {results.method === "staircase" && <Tracks results={results} />}
      {results.method === "rating" && <Ratings results={results} />}
    </>
  );
}

function Pairs({ results }: { results: StudyResults }) {
  const names = results.stimuli.map(stimulusName);
  const rows = names.map((name, index) => ({ name, wins: results.wins![index]!, worth: results.worths?.[index] }));
  return (
    <>
      <h3>Number of times that a row was chosen over a column</h3>
      <Table
        savable
        caption="Wins"
        testId="study-wins"
        rows={rows}
        columns={[
          { key: "name", label: "Texture" },
          ...names.map((label, column) => ({ key: `c${column}`, label, numeric: true, cell: (row: (typeof rows)[number]) => row.wins[column] ?? "–" })),
          { key: "worth", label: "Worth, ln", numeric: true, cell: (row) => (row.worth ? worthWords(row.worth) : "–") },
        ]}
      />
      {!results.worths_exist && <p class="field-hint">No worths can be computed yet, because some textures were always chosen over the others or were not compared with them.</p>}
      <h3>Pairs</h3>
      <Table<PairShare>
        savable
        caption="Pairs, with intervals of 95 %"
        testId="study-pairs"
        rows={results.pairs!}
        columns={[
          { key: "pair", label: "Pair", cell: (row) => `${names[row.first]} over ${names[row.second]}` },
          { key: "trials", label: "Trials", numeric: true, cell: (row) => String(row.trials) },
          { key: "share", label: "Share (95 %)", numeric: true, cell: shareWords },
        ]}
      />
    </>
  );
}

function Tracks({ results }: { results: StudyResults }) {
  const [at, setAt] = useState(0);
  const names = results.stimuli.map(stimulusName);
  const tracks = results.tracks!;
  const track = tracks[Math.min(at, tracks.length - 1)]!;
  const words = (index: number) => `${names[tracks[index]!.stimulus]}, ${tracks[index]!.repetition}`;
  return (
    <>
      <Table<Track>
        savable
        caption={`Thresholds: ${parameterWords(results.parameter)}`}
        testId="study-thresholds"
        rows={tracks}
        onChoose={(_, index) => setAt(index)}
        chosen={(_, index) => index === at}
        columns={[
          { key: "name", label: "Texture, repetition", cell: (_, index) => words(index) },
          { key: "threshold", label: `Level at ${fixed(100 * results.target!, 1)} % correct (± SE)`, numeric: true, cell: thresholdWords },
          { key: "trials", label: "Trials", numeric: true, cell: (row) => row.levels.length },
          { key: "turns", label: "Reversals", numeric: true, cell: (row) => row.reversals.length },
          { key: "done", label: "Complete", cell: (row) => (row.done ? "yes" : "no") },
        ]}
      />
      {tracks.some((each) => each.at_limit) && (
        <p class="field-hint" data-testid="study-at-limit">
          A track with a reversal at the lowest or highest level has no threshold. The threshold is beyond that level, or the answers were guessed. Widen the levels.
        </p>
      )}
      {tracks.length > 1 && (
        <Select label="Track" value={String(at)} options={tracks.map((_, index) => ({ value: String(index), label: words(index) }))} onChange={(value) => setAt(Number(value))} />
      )}
      <div class="study-plot">
        <Plot label={`Staircase of ${words(Math.min(at, tracks.length - 1))}`} series={trackSeries(track)} logY xAxis={{ label: "trial of the track", unit: "" }} yAxis={{ label: parameterWords(results.parameter), unit: "" }} testId="study-staircase" />
      </div>
    </>
  );
}

function Ratings({ results }: { results: StudyResults }) {
  const names = results.stimuli.map(stimulusName);
  return (
    <Table<Rating>
      savable
      caption="Ratings, means with intervals of 95 %"
      testId="study-ratings"
      rows={results.ratings!}
      columns={[
        { key: "name", label: "Texture", cell: (row) => names[row.stimulus] },
        { key: "mean", label: "Mean (95 %)", numeric: true, cell: (row) => (row.mean === undefined ? "–" : `${fixed(row.mean, 2)} (${fixed(row.low, 2)} to ${fixed(row.high, 2)})`) },
        { key: "deviation", label: "Deviation", numeric: true, cell: (row) => fixed(row.deviation, 2) },
        { key: "count", label: "Ratings", numeric: true, cell: (row) => String(row.count) },
        ...[0, 1, 2, 3, 4, 5, 6].map((index) => ({ key: `r${index}`, label: String(index + 1), numeric: true, cell: (row: Rating) => row.counts[index] })),
      ]}
    />
  );
}
