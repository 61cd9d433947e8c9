import { useEffect, useMemo, useState } from "preact/hooks";
import { Plot } from "../../plot/Plot";
import { IconButton } from "../../ui/IconButton";
import { Panel } from "../../ui/Panel";
import { iterations, running, scrub, showing } from "./alignState";
import { mainLine, seriesOf } from "./iterations";

const kStep_ms = 60;

/** The residual of every iteration, and a slider that goes back to each. */
export function IterationStrip() {
  const known = iterations.value;
  const count = known.poses.length;
  const [playing, setPlaying] = useState(false);
  const series = useMemo(() => seriesOf(known), [known]);
  const marked = showing.value === "iteration" && count > 0 ? scrub.value + 1 : 0;
  const marks = useMemo(() => (marked ? [{ x: marked, label: `${marked}` }] : []), [marked]);
  useEffect(() => {
    if (!playing) return;
    const line = mainLine(iterations.value);
    let at = 0;
    const timer = setInterval(() => {
      if (at >= line.length || running.value) return setPlaying(false);
      goTo(line[at++]!);
    }, kStep_ms);
    return () => clearInterval(timer);
  }, [playing]);
  return (
    <Panel title="Iterations" grow testId="align-iterations">
      <div class="align-strip">
        <Plot
          key={`${known.run} ${running.value} ${Math.ceil(Math.log2(count + 1))}`}
          label="Residual of each iteration of the registration"
          series={series}
          xAxis={{ label: "iteration" }}
          yAxis={{ label: "RMS", unit: "mm" }}
          logY
          marks={marks}
          onPick={(x) => goTo(Math.round(x) - 1)}
          legend
          empty={running.value ? "Registering …" : "Run a registration to see its iterations here."}
        />
        <div class="align-scrub">
          <IconButton
            icon={playing ? "pause" : "play"}
            label={playing ? "Stop" : "Play the iterations from the guess"}
            onClick={() => setPlaying(!playing)}
            disabled={count === 0 || running.value}
          />
          <label>
            <span>Iteration</span>
            <input
              type="range"
              min={1}
              max={Math.max(1, count)}
              value={Math.min(count, scrub.value + 1)}
              disabled={count === 0}
              aria-valuetext={`${scrub.value + 1} of ${count}`}
              data-testid="align-scrub"
              onInput={(event) => goTo(Number(event.currentTarget.value) - 1)}
            />
          </label>
          <output data-testid="align-count">
            {count ? `${Math.min(count, scrub.value + 1)} of ${count}` : "none"}
          </output>
        </div>
      </div>
    </Panel>
  );
}

function goTo(index: number): void {
  const count = iterations.value.poses.length;
  if (count === 0) return;
  scrub.value = Math.max(0, Math.min(count - 1, index));
  showing.value = "iteration";
}
