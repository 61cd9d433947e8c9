import { useEffect, useState } from "preact/hooks";
import { call, link, onEvent } from "../net/connection";
import { Button } from "../ui/Button";
import { quantity } from "../ui/format";
import { complain } from "../ui/toast";
import { openEntry } from "./openEntry";

interface RescuedScan {
  recording: string | null;
  duration_s: number;
  problem: string;
}

/** Offers what is left of a scan that a studio before did not finish. */
export function Rescued() {
  const [scan, setScan] = useState<RescuedScan | null>(null);
  const read = () => call<RescuedScan>("scan.rescued").then(setScan, complain);
  useEffect(() => {
    if (link.value === "open") void read();
  }, [link.value]);
  useEffect(() => onEvent("rescued", () => void read()), []);
  if (!scan?.recording) return null;
  const forget = () => call("scan.forget_rescued");
  const show = async () => {
    await openEntry("recording", scan.recording!);
    await forget();
  };
  return (
    <div class="shell-notice" role="status" data-testid="rescued">
      <p>
        The studio ended during a scan.{" "}
        {scan.problem
          ? `The recording ${scan.recording} cannot be read: ${scan.problem}. Save its readable data: asperity recover ${scan.recording} -o ${scan.recording}_saved`
          : `${quantity(scan.duration_s, "s")} of it were saved in the recording ${scan.recording}.`}
      </p>
      {!scan.problem && (
        <Button kind="primary" onClick={show} testId="rescued-open">
          Open in Process
        </Button>
      )}
      <Button onClick={forget} testId="rescued-dismiss">
        Dismiss
      </Button>
    </div>
  );
}
