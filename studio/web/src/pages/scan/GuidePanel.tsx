import { guided } from "../../app/guide";
import { Button } from "../../ui/Button";
import { Panel } from "../../ui/Panel";
import { open, openInProcess, start, stop } from "./commands";
import { scan } from "./settings";
import { stepOf } from "./guideSteps";
import { refined, state } from "./stream";

/** The first scan, step by step; each step has its button. */
export function GuidePanel() {
  if (!guided.value) return null;
  const now = stepOf(state.value, refined.value?.head);
  const steps = [
    { words: scan.value.source === "bench" ? "Open the virtual bench. It simulates a probe, a camera and a hand." : "Open the source of the samples.", button: "Open", run: open },
    { words: "Press Start. The hand begins to stroke the surface, and the profile grows below.", button: "Start", run: start },
    { words: "Watch the profile for some seconds, then press Stop.", button: "Stop", run: stop },
    { words: "Wait for the refined profile: the studio computes the scan again with all data.", button: "", run: () => undefined },
    { words: "Done. Look at spectrum, roughness and verdict on the Process page.", button: "Open in Process", run: finish },
  ];
  return (
    <Panel title="Your first scan" actions={<Button kind="quiet" onClick={() => (guided.value = false)}>End the guide</Button>} testId="scan-guide">
      <ol class="scan-guide">
        {steps.map(({ words, button, run }, index) => (
          <li key={index} aria-current={index === now ? "step" : undefined}>
            {words}
            {index === now && button && (
              <Button kind="primary" onClick={run} testId="scan-guide-next">
                {button}
              </Button>
            )}
          </li>
        ))}
      </ol>
    </Panel>
  );
}

async function finish(): Promise<void> {
  await openInProcess();
  guided.value = false;
}
