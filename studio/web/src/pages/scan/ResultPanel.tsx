import { VerdictList } from "../../measured/VerdictList";
import { verdictsOf } from "../../measured/verdicts";
import { Button } from "../../ui/Button";
import { Figure } from "../../ui/Figure";
import { Figures } from "../../ui/Figures";
import { fixed } from "../../ui/format";
import { Panel } from "../../ui/Panel";
import { openInProcess } from "./commands";
import { isLiveUsable } from "./scanState";
import { refined, state } from "./stream";

/** The last scan worked out in full, and its difference from the live profile. */
export function ResultPanel() {
  const head = refined.value?.head;
  return (
    <Panel title="Refined on stop" testId="scan-result">
      {!head && <p class="empty">Stop a scan to compute its refined profile.</p>}
      {head?.failure && <p role="alert">{head.failure}</p>}
      {head && !head.failure && (
        <>
          <Figures>
            <Figure label="Length" value={head.length_m} factor={1e3} unit="mm" />
            <Figure label="Mean speed" value={head.speed_mps} factor={1e3} unit="mm/s" digits={3} />
            <Figure label="Ra" value={head.roughness?.Ra_m} factor={1e6} unit="µm" digits={3} testId="scan-ra" />
            <Figure label="Correlation, live and refined" value={head.difference ? `r\u00a0=\u00a0${fixed(head.difference.correlation, 4)}` : "–"} testId="scan-correlation"
              hint="Correlation of the live and the refined profile in the band of comparison" />
            <Figure label="RMS difference" value={head.difference?.rms_um} unit="µm" digits={3} testId="scan-rms" />
            <Figure label="Computing time" value={`${Math.round(head.took_s * 1e3)}\u202fms`} testId="scan-took" />
          </Figures>
          {!isLiveUsable(head.difference) && <p class="field-hint">The live profile had too few data and is not shown.</p>}
          {verdictsOf(head).length > 0 && (
            <div class="field-error" role="status">
              <VerdictList verdicts={verdictsOf(head)} />
            </div>
          )}
          <Button onClick={openInProcess} testId="scan-to-process"
            hint={state.value?.open ? "Finishes the recording, closes the source and opens it on the Process page" : undefined}>
            Open in Process
          </Button>
        </>
      )}
    </Panel>
  );
}
